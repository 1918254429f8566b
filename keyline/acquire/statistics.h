#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/core/quantile.h"

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

/// The same of the box of middle halves of the coordinates: what a stray, however far, leaves
/// alone.
inline double middle_extent_of(std::span<const core::Point2> points) {
  std::vector<double> x, y;
  for (const core::Point2& p : points) {
    x.push_back(p.x);
    y.push_back(p.y);
  }
  const auto middle = [](const std::vector<double>& values) {
    return core::quantile(values, 3, 4) - core::quantile(values, 1, 4);
  };
  return std::hypot(middle(x), middle(y));
}

}  // namespace keyline::acquire::detail
