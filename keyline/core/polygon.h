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

/// Mean of the points, without loss far from the origin. Precondition: there is one.
template <class Points>
auto centroid(const Points& points) {
  const auto& first = points.front();
  auto sum = first - first;
  for (const auto& p : points) sum = sum + (p - first);
  return first + sum / static_cast<double>(points.size());
}

}  // namespace keyline::core
