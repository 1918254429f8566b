#include "keyline/lac/g2/spline_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "keyline/core/angle.h"

namespace keyline::lac::detail {
namespace {

using core::Point2;

constexpr double kRounding = 1e-9;

/// Equal numbers for values that are equal but for rounding, greater ones for greater values.
/// unit: below kRounding of it values are 0.
std::vector<int> ranks(const std::vector<double>& values, double unit) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<int> rank(values.size());
  int current = 0;
  double before = 0;
  for (const std::size_t i : order) {
    const double value = values[i];
    if (value - before > kRounding * (unit + std::abs(value) + std::abs(before))) ++current;
    rank[i] = current;
    before = value;
  }
  return rank;
}

/// As ranks, of the magnitudes, with the sign of the value.
std::vector<int> signed_ranks(const std::vector<double>& values, double unit) {
  std::vector<double> magnitudes;
  for (const double value : values) magnitudes.push_back(std::abs(value));
  std::vector<int> rank = ranks(magnitudes, unit);
  for (std::size_t i = 0; i < rank.size(); ++i)
    if (values[i] < 0) rank[i] = -rank[i];
  return rank;
}

/// A point with what is to the next one: ranks of chord, slope, turn and curvature. The last two
/// change their sign in a mirror and on the way back.
using Mark = std::array<int, 4>;
constexpr int kNone = std::numeric_limits<int>::min();

/// Of the points of a request, those of the spans apart since the way back pairs them otherwise.
struct Marks {
  std::vector<std::array<int, 2>> of_span;
  std::vector<std::array<int, 2>> of_point;
};

std::vector<Mark> marks_on_way(const Marks& marks, const SplineStart& way, bool mirrored) {
  const std::size_t points = marks.of_point.size();
  std::vector<Mark> on_way;
  for (std::size_t i = 0; i < points; ++i) {
    Mark mark{kNone, kNone, kNone, kNone};
    if (i < way.spans) std::ranges::copy(marks.of_span[way.span(i)], mark.begin());
    auto odd = marks.of_point[way.at(i, points)];
    for (int& rank : odd)
      if (rank != kNone && way.backwards != mirrored) rank = -rank;
    std::ranges::copy(odd, mark.begin() + 2);
    on_way.push_back(mark);
  }
  return on_way;
}

Marks marks_of(std::span<const Point2> points, const SplineOptions& options) {
  const std::size_t slots = points.size();
  const std::size_t spans = options.closed ? slots : slots - 1;
  const auto chord = [&](std::size_t i) { return points[(i + 1) % slots] - points[i]; };
  std::vector<double> chords, slopes(spans, 0), turns(slots, 0), curvatures(slots, 0);
  for (std::size_t i = 0; i < spans; ++i) chords.push_back(norm(chord(i)));
  if (options.alpha.size() == spans) slopes = options.alpha;
  for (std::size_t i = 0; i < slots; ++i)
    if (options.closed || (i > 0 && i < spans))
      turns[i] = core::angle_between(chord((i + spans - 1) % spans), chord(i));
  const SplineEnd& start = options.start;
  const SplineEnd& end = options.end;
  if (start.direction) turns[0] = core::wrap_angle(core::direction_of(chord(0)) - *start.direction);
  if (end.direction)
    turns[spans] = core::wrap_angle(*end.direction - core::direction_of(chord(spans - 1)));
  if (start.curvature) curvatures[0] = *start.curvature;
  if (end.curvature) curvatures[spans] = *end.curvature;
  const auto chord_rank = ranks(chords, 0), slope_rank = ranks(slopes, 0);
  const auto turn_rank = signed_ranks(turns, 1), curvature_rank = signed_ranks(curvatures, 0);
  Marks marks;
  for (std::size_t i = 0; i < spans; ++i) marks.of_span.push_back({chord_rank[i], slope_rank[i]});
  for (std::size_t i = 0; i < slots; ++i)
    marks.of_point.push_back({turn_rank[i], curvature_rank[i]});
  if (options.closed) return marks;
  if (!start.direction) marks.of_point.front()[0] = kNone;
  if (!end.direction) marks.of_point.back()[0] = kNone;
  if (!start.curvature) marks.of_point.front()[1] = kNone;
  if (!end.curvature) marks.of_point.back()[1] = kNone;
  return marks;
}

/// Where to begin in a ring to read what is greatest, by comparing two beginnings at a time: none
/// of those passed over is better (Shiloach, J. Algorithms 2, 1981).
std::size_t greatest_rotation(const std::vector<Mark>& ring) {
  const std::size_t n = ring.size();
  std::size_t a = 0, b = 1, same = 0;
  while (a < n && b < n && same < n) {
    const Mark& of_a = ring[(a + same) % n];
    const Mark& of_b = ring[(b + same) % n];
    if (of_a == of_b) {
      ++same;
      continue;
    }
    (of_a < of_b ? a : b) += same + 1;
    if (a == b) ++b;
    same = 0;
  }
  return std::min(a, b);
}

}  // namespace

SplineStart spline_start(std::span<const Point2> points, const SplineOptions& options) {
  const std::size_t spans = options.closed ? points.size() : points.size() - 1;
  const Marks marks = marks_of(points, options);
  SplineStart best;
  std::vector<Mark> most;
  for (const bool backwards : {false, true})
    for (const bool mirrored : {false, true}) {
      SplineStart way{backwards && !options.closed ? spans : 0, backwards, spans};
      auto read = marks_on_way(marks, way, mirrored);
      if (options.closed) {
        const std::size_t first = greatest_rotation(read);
        std::rotate(read.begin(), read.begin() + static_cast<std::ptrdiff_t>(first), read.end());
        way.point = way.at(first, points.size());
      }
      if (read <= most) continue;
      most = std::move(read);
      best = way;
    }
  return best;
}

std::vector<Point2> travelled(std::span<const Point2> points, const SplineStart& way) {
  std::vector<Point2> on_way;
  for (std::size_t i = 0; i < points.size(); ++i)
    on_way.push_back(points[way.at(i, points.size())]);
  return on_way;
}

SplineOptions travelled(const SplineOptions& options, const SplineStart& way) {
  SplineOptions on_way = options;
  if (options.alpha.size() == way.spans)
    for (std::size_t i = 0; i < way.spans; ++i) on_way.alpha[i] = options.alpha[way.span(i)];
  if (!way.backwards) return on_way;
  std::swap(on_way.start, on_way.end);
  for (SplineEnd* end : {&on_way.start, &on_way.end}) {
    if (end->direction) end->direction = core::wrap_angle(*end->direction + core::kPi);
    if (end->curvature) end->curvature = -*end->curvature;
  }
  return on_way;
}

SplineSolution as_asked(const SplineSolution& solution, const SplineStart& way) {
  SplineSolution asked = solution;
  if (way.backwards) {
    asked.chain = reverse(solution.chain);
    std::ranges::reverse(asked.span);
  }
  for (auto* list : {&asked.span, &asked.overridden})
    for (std::size_t& span : *list) span = way.span(span);
  std::ranges::sort(asked.overridden);
  auto& pieces = asked.chain.pieces;
  const auto first = std::ranges::min_element(asked.span) - asked.span.begin();
  std::rotate(pieces.begin(), pieces.begin() + first, pieces.end());
  std::rotate(asked.span.begin(), asked.span.begin() + first, asked.span.end());
  return asked;
}

}  // namespace keyline::lac::detail
