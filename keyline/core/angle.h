#pragma once

#include <cmath>
#include <numbers>

#include "keyline/core/point.h"

/// Conventions of the whole library, stated here once:
/// angles are radians, counter-clockwise positive; signed curvature is positive when the curve
/// turns left; curve parameters lie in [0, 1]; lengths are in the document's unit. A curve made
/// from handles P0, P1, P2 runs from P0 to P2. Tolerances are arguments, never globals.
namespace keyline::core {

inline constexpr double kPi = std::numbers::pi;

/// Same direction in (-pi, pi].
inline double wrap_angle(double radians) {
  const double r = std::remainder(radians, 2 * kPi);
  return r <= -kPi ? kPi : r;
}

/// Angle from a to b in (-pi, pi], counter-clockwise positive; 0 if either is the zero vector.
inline double angle_between(Vector2 a, Vector2 b) { return std::atan2(cross(a, b), dot(a, b)); }

/// Direction of v in (-pi, pi].
inline double direction_of(Vector2 v) { return std::atan2(v.y, v.x); }

/// Unit vector of the given direction.
inline Vector2 unit_vector(double direction) { return {std::cos(direction), std::sin(direction)}; }

/// v turned counter-clockwise.
inline Vector2 rotate_ccw(Vector2 v, double radians) {
  const double c = std::cos(radians);
  const double s = std::sin(radians);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

}  // namespace keyline::core
