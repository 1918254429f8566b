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
};

/// The plane through the first point that is spanned by the direction to the farthest point and by
/// the offset farthest from that direction. Any plane will do for points on a line.
Flattened flatten(std::span<const core::Point3> points);

}  // namespace keyline::classa::detail
