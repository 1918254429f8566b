#pragma once

#include <vector>

#include "keyline/classa/cav.h"
#include "keyline/core/describe.h"

/// The alpha-s plane about a curve, as pictures and pages draw it.
namespace keyline::operations {

struct ClassAPlane {
  core::Interval alpha;
  core::Interval s;
  /// Strain energy of curves of that degree whose ends are as far apart, wherever they lead.
  std::vector<std::vector<double>> energy;
  std::vector<core::Point2> growing;  ///< s = 1/cos alpha: Class A from there on
  std::vector<core::Point2> falling;  ///< s = cos alpha: Class A up to there
  std::vector<core::Point2> reach;    ///< places that keep the ends and the start tangent
  static constexpr auto describe() {
    using Plane = ClassAPlane;
    return core::fields(
        core::field<&Plane::alpha>("shown").in("radian"), core::field<&Plane::s>("shown"),
        core::field<&Plane::energy>(
            "strain energy of curves with ends as far apart, at even steps: rows along s, from the "
            "least")
            .in("1/length"),
        core::field<&Plane::growing>("[alpha, s] where Class A begins for edges that grow"),
        core::field<&Plane::falling>("where it begins for edges that shrink"),
        core::field<&Plane::reach>("of curves with the same ends and start tangent"));
  }
};

/// Precondition: a curve of degree 2 or more whose ends are apart; 0 < alpha_max < pi/2; s of
/// positive numbers.
ClassAPlane class_a_plane(const classa::CurveReading& reading, double alpha_max, core::Interval s);

}  // namespace keyline::operations
