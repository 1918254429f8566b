#include "keyline/lac/g2/spline.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/lac/g2/spline_forward.h"
#include "keyline/lac/g2/spline_local.h"

namespace keyline::lac {
namespace {

using core::Point2;

/// Travelled the other way; closed from the same point.
std::vector<Point2> turned_round(std::span<const Point2> points, bool closed) {
  std::vector<Point2> turned(points.rbegin(), points.rend());
  if (closed) std::rotate(turned.begin(), turned.end() - 1, turned.end());
  return turned;
}

SplineEnd turned_round(const SplineEnd& end) {
  SplineEnd turned = end;
  if (end.direction) turned.direction = core::wrap_angle(*end.direction + core::kPi);
  if (end.curvature) turned.curvature = -*end.curvature;
  return turned;
}

SplineOptions turned_round(const SplineOptions& options) {
  SplineOptions turned = options;
  std::ranges::reverse(turned.alpha);
  turned.start = turned_round(options.end);
  turned.end = turned_round(options.start);
  return turned;
}

SplineSolution turned_round(const SplineSolution& solution, std::size_t spans) {
  SplineSolution turned = solution;
  turned.chain = reverse(solution.chain);
  for (auto* list : {&turned.span, &turned.overridden}) {
    std::ranges::reverse(*list);
    for (std::size_t& span : *list) span = spans - 1 - span;
  }
  return turned;
}

/// Told by the first chord, then slope, that differs from its counterpart by more than rounding.
bool sets_out_from_the_end(std::span<const Point2> points, const SplineOptions& options,
                           std::size_t spans) {
  constexpr double kRounding = 1e-9;
  const auto chord = [&](std::size_t i) {
    return distance(points[i], points[(i + 1) % points.size()]);
  };
  for (std::size_t i = 0; i < spans / 2; ++i) {
    const double here = chord(i), there = chord(spans - 1 - i);
    if (std::abs(here - there) > kRounding * (here + there)) return there > here;
  }
  if (options.alpha.size() != spans) return false;
  for (std::size_t i = 0; i < spans / 2; ++i) {
    const double here = options.alpha[i], there = options.alpha[spans - 1 - i];
    if (here != there) return there > here;
  }
  return false;
}

}  // namespace

core::Result<SplineSolution> solve_spline(std::span<const Point2> points,
                                          const SplineOptions& options) {
  using detail::solve_spline_forward;
  if (options.closed && points.size() > 1 && points.front() == points.back())
    points = points.first(points.size() - 1);
  const std::size_t spans = options.closed || points.empty() ? points.size() : points.size() - 1;
  if (!sets_out_from_the_end(points, options, spans)) return solve_spline_forward(points, options);
  const auto back =
      solve_spline_forward(turned_round(points, options.closed), turned_round(options));
  if (!back)
    return solve_spline_forward(points, options);  // whose reason names the points as given
  SplineSolution solution = turned_round(*back, spans);
  solution.chain.start.position = points.front();
  solution.deviation = detail::deviation_of(points, solution);
  return solution;
}

}  // namespace keyline::lac
