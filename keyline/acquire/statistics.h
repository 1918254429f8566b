#pragma once

#include <algorithm>
#include <span>

#include "keyline/core/point.h"

namespace keyline::acquire::detail {

/// Diagonal of the points' bounding box; 0 for none.
inline double extent_of(std::span<const core::Point2> points) {
  if (points.empty()) return 0;
  core::Point2 low = points[0], high = points[0];
  for (const core::Point2& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return core::distance(low, high);
}

}  // namespace keyline::acquire::detail
