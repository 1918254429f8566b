#pragma once

#include <cstddef>

#include "keyline/core/point.h"

namespace keyline::core {

/// Length of the polygon through the points in their order (a vector, array or span of Point2 or
/// Point3), with the edge from the last back to the first where closed; 0 for fewer than two
/// points.
template <class Points>
double polygon_length(const Points& points, bool closed = false) {
  if (points.empty()) return 0;
  double sum = closed ? distance(points.back(), points.front()) : 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
  return sum;
}

}  // namespace keyline::core
