#include <stdexcept>

#include "keyline/lac/segment/segment.h"
#include "keyline/lac/segment/segment_table.h"

namespace keyline::lac {

using core::Point2;

void sample(const Segment& segment, std::span<const double> at, std::span<Point2> points) {
  if (at.size() != points.size()) throw core::InvalidInput("sample: sizes of the spans differ");
  const SegmentTable table(segment);
  for (std::size_t i = 0; i < at.size(); ++i) points[i] = table.point(at[i]);
}

std::vector<Point2> sample(const Segment& segment, int n) {
  if (n < 2) throw core::InvalidInput("sample: fewer than two points asked for");
  std::vector<double> at(n);
  for (int i = 0; i < n; ++i) at[i] = i / (n - 1.0);
  std::vector<Point2> points(n);
  sample(segment, at, points);
  return points;
}

}  // namespace keyline::lac
