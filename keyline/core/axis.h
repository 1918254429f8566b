#pragma once

#include <cmath>

#include "keyline/core/point.h"

namespace keyline::core {

/// Angle between a and b in [0, pi]; 0 if either is the zero vector.
inline double angle_between(Vector3 a, Vector3 b) {
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

/// Angle, in (-pi/2, pi/2], of the axis along which the symmetric form (xx, xy; xy, yy) is largest:
/// where these are second moments, the direction in which points spread most.
inline double principal_angle(double xx, double xy, double yy) {
  return 0.5 * std::atan2(2 * xy, xx - yy);
}

}  // namespace keyline::core
