#include "keyline/sketch/polyline_tools.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/polygon.h"
#include "keyline/core/second_moments.h"

namespace keyline::sketch {

using core::Point2;
using core::Vector2;

void resample(const std::vector<Point2>& points, const std::vector<double>& values, double spacing,
              bool closed, std::vector<Point2>& out, std::vector<double>& out_values) {
  out.clear();
  out_values.clear();
  if (points.empty()) return;
  const double length = core::polygon_length(points, closed);
  const std::size_t least = closed ? 3 : 1;
  const std::size_t steps =
      std::max(least, static_cast<std::size_t>(std::lround(length / spacing)));
  const std::size_t count = closed ? steps : steps + 1;
  const std::size_t n = points.size();
  std::size_t i = 0;
  double start = 0;  // arc length at point i
  for (std::size_t k = 0; k < count; ++k) {
    const double s = length * static_cast<double>(k) / static_cast<double>(steps);
    double edge = core::distance(points[i], points[(i + 1) % n]);
    while (i + 2 < n + (closed ? 1 : 0) && start + edge < s) {
      start += edge;
      ++i;
      edge = core::distance(points[i], points[(i + 1) % n]);
    }
    const double u = edge > 0 ? std::clamp((s - start) / edge, 0.0, 1.0) : 0;
    out.push_back(core::mix(points[i], points[(i + 1) % n], u));
    out_values.push_back((1 - u) * values[i] + u * values[(i + 1) % n]);
  }
}

Axis principal_axis(const std::vector<Point2>& points, std::size_t first, std::size_t last) {
  Axis axis;
  const auto count = static_cast<double>(last - first + 1);
  for (std::size_t i = first; i <= last; ++i)
    axis.centre = axis.centre + (points[i] - Point2{}) / count;
  core::SecondMoments moments;
  for (std::size_t i = first; i <= last; ++i) moments.add(points[i] - axis.centre);
  axis.direction = moments.direction();
  if (core::dot(axis.direction, points[last] - points[first]) < 0) axis.direction = -axis.direction;
  for (std::size_t i = first; i <= last; ++i)
    axis.largest_offset = std::max(axis.largest_offset,
                                   std::abs(core::cross(axis.direction, points[i] - axis.centre)));
  return axis;
}

}  // namespace keyline::sketch
