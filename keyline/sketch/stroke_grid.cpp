#include "keyline/sketch/stroke_grid.h"

#include <algorithm>

#include "keyline/core/polygon.h"
#include "keyline/sketch/polyline_tools.h"

namespace keyline::sketch {

SampledStroke sample_stroke(const std::vector<core::Point2>& points, bool closed, double step) {
  SampledStroke s;
  s.closed = closed;
  s.length = core::polygon_length(points, closed);
  std::vector<double> unused;
  resample(points, std::vector<double>(points.size(), 0), step, closed, s.points, unused);
  const std::size_t n = s.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i > 1 ? i - 2 : closed ? (i + 2 * n - 2) % n : 0;
    const std::size_t after = closed ? (i + 2) % n : std::min(i + 2, n - 1);
    const core::Vector2 d = s.points[after] - s.points[before];
    s.tangents.push_back(core::norm(d) > 0 ? d / core::norm(d) : core::Vector2{1, 0});
  }
  return s;
}

}  // namespace keyline::sketch
