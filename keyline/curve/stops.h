#pragma once

#include <optional>
#include <vector>

#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"

namespace keyline::curve {

/// A side of a place where a curve stops, as its points see it that come near the place.
struct StopSide {
  core::Vector2 tangent;  ///< of travel, unit length
  double curvature = 0;   ///< its limit: finite, 0 or an infinity
};

/// A place where the first derivative is zero: an end with its handle drawn in, or a cusp inside.
struct Stop {
  double t = 0;
  std::optional<StopSide> before;  ///< empty at t = 0, and where only the other side stops
  std::optional<StopSide> after;   ///< empty at t = 1, and where only the other side stops
};

/// Places where a curve stops, in order. With h = c_m u^m + … the derivative near such a place (of
/// a rational curve: its numerator) and a = c_m, c_(m+k) the first coefficient that is not parallel
/// to a, curvature is k (a x c_(m+k)) / |a|^3 u^(k-1-m), times the squared weight: infinite for k
/// <= m, finite for k = m + 1.
///
/// A derivative counts as zero below the rounding of coordinates of the curve's size; a curve that
/// is one point has no such place. Precondition: the curve is valid.
std::vector<Stop> stops_of(const Bezier2& c);
/// Of a spline a joint of two pieces may stop on one side alone.
std::vector<Stop> stops_of(const BSpline2& c);

}  // namespace keyline::curve
