#pragma once

#include "keyline/core/angle.h"
#include "keyline/core/point.h"

namespace keyline::curve {

/// Point of a curve with its first three derivatives in the curve's parameter t.
template <class Point>
struct Jet {
  Point point;
  core::Displacement<Point> first;
  core::Displacement<Point> second;
  core::Displacement<Point> third;
  friend bool operator==(const Jet&, const Jet&) = default;
};
using Jet2 = Jet<core::Point2>;
using Jet3 = Jet<core::Point3>;

/// |dp/dt|, in document units per parameter unit.
template <class Point>
double speed(const Jet<Point>& jet) {
  return norm(jet.first);
}

/// Direction of travel in (-pi, pi]. Where the speed is zero, the direction in which the curve
/// leaves for growing t (first derivative that does not vanish); 0 where all three vanish.
double tangent_angle(const Jet2& jet);

/// Unit vector of tangent_angle.
core::Vector2 unit_tangent(const Jet2& jet);

/// Signed curvature, positive where the curve turns left, in 1/length. Where the speed is zero:
/// the limit for growing t, which is 0 (straight) or an infinity with the sign of the turning.
double curvature(const Jet2& jet);

/// Change of signed curvature by arc length, dkappa/ds, in 1/length^2. Where the speed is zero:
/// the limit for growing t, 0 (straight) or an infinity.
double curvature_rate(const Jet2& jet);

/// Centre of the osculating circle: a point of the evolute. Not finite where curvature is 0.
core::Point2 centre_of_curvature(const Jet2& jet);

/// Curvature (never negative) and torsion of a space curve; torsion is 0 where curvature is.
double curvature(const Jet3& jet);
double torsion(const Jet3& jet);

/// The jet in the parameter 1 - t: derivatives of odd order change sign.
template <class Point>
Jet<Point> reversed(const Jet<Point>& jet) {
  return {jet.point, -jet.first, jet.second, -jet.third};
}

/// The jet in a parameter u with dt/du = factor (constant).
template <class Point>
Jet<Point> rescaled(const Jet<Point>& jet, double factor) {
  return {jet.point, factor * jet.first, factor * factor * jet.second,
          factor * factor * factor * jet.third};
}

}  // namespace keyline::curve
