#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

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

/// The value that the share part / of of the values stays below (the middle one unless told); a
/// value-initialised one for none.
template <class Value>
Value quantile(std::vector<Value> values, std::size_t part = 1, std::size_t of = 2) {
  if (values.empty()) return {};
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * part / of);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace keyline::acquire::detail
