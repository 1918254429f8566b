#pragma once

#include <span>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::classa::detail {

/// Points in space laid into a plane.
struct Flattened {
  std::vector<core::Point2> points;  ///< first point at the origin
  double off_plane = 0;              ///< largest distance of a point from the plane
  double size = 0;                   ///< largest distance from the first point
  core::Point3 origin = {};          ///< the first point
  core::Vector3 x = {1, 0, 0};       ///< unit axes of the plane
  core::Vector3 y = {0, 1, 0};

  core::Point3 lifted(core::Point2 p) const { return origin + (p.x * x + p.y * y); }
};

/// The plane through the first point that is spanned by the direction to the farthest point and by
/// the offset farthest from that direction. Any plane will do for points on a line.
Flattened flatten(std::span<const core::Point3> points);

}  // namespace keyline::classa::detail
