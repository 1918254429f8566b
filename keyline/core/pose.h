#pragma once

#include "keyline/core/angle.h"
#include "keyline/core/point.h"

namespace keyline::core {

/// Where a planar curve starts and which way it goes; direction in radians.
struct Pose2 {
  Point2 position;
  double direction = 0;
  friend bool operator==(const Pose2&, const Pose2&) = default;
};

/// p of the pose's own frame (x axis along the direction) in the frame the pose is given in.
inline Point2 from_local(const Pose2& pose, Point2 p) {
  return pose.position + rotate_ccw({p.x, p.y}, pose.direction);
}

/// Inverse of from_local.
inline Point2 to_local(const Pose2& pose, Point2 p) {
  const Vector2 v = rotate_ccw(p - pose.position, -pose.direction);
  return {v.x, v.y};
}

}  // namespace keyline::core
