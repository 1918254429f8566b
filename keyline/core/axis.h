#pragma once

#include <cmath>

#include "keyline/core/point.h"

namespace keyline::core {

/// Angle between a and b in [0, pi]; 0 if either is the zero vector.
inline double angle_between(Vector3 a, Vector3 b) {
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

/// A unit vector at right angles to the unit vector a, whichever.
inline Vector3 any_normal(Vector3 a) {
  const Vector3 n = cross(a, std::abs(a.x) < 0.6 ? Vector3{1, 0, 0} : Vector3{0, 1, 0});
  return n / norm(n);
}

/// Angle, in (-pi/2, pi/2], of the axis along which the symmetric form (xx, xy; xy, yy) is largest:
/// where these are second moments, the direction in which points spread most.
inline double principal_angle(double xx, double xy, double yy) {
  return 0.5 * std::atan2(2 * xy, xx - yy);
}

}  // namespace keyline::core
