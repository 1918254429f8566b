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

/// What tells the ends apart, neither turned nor mirrored: chords, turns at the points, slopes, and
/// what is wanted at the start. Angles count from 1, so that rounding of none tells nothing.
std::vector<double> marks(std::span<const Point2> points, const SplineOptions& options,
                          std::size_t spans) {
  const auto chord = [&](std::size_t i) { return points[(i + 1) % points.size()] - points[i]; };
  std::vector<double> all;
  for (std::size_t i = 0; i < spans; ++i) all.push_back(norm(chord(i)));
  for (std::size_t i = 1; i < spans; ++i)
    all.push_back(1 + std::abs(core::angle_between(chord(i - 1), chord(i))));
  if (options.alpha.size() == spans)
    all.insert(all.end(), options.alpha.begin(), options.alpha.end());
  const auto& [direction, curvature] = options.start;
  const double first = core::direction_of(chord(0));
  all.push_back(direction ? 1 + std::abs(core::wrap_angle(*direction - first)) : 0);
  all.push_back(curvature ? std::abs(*curvature) : -1);
  return all;
}

/// Told by the first mark that differs from the other end's by more than rounding.
bool sets_out_from_the_end(std::span<const Point2> points, const SplineOptions& options,
                           std::size_t spans) {
  constexpr double kRounding = 1e-9;
  if (spans == 0) return false;
  const auto here = marks(points, options, spans);
  const auto there = marks(turned_round(points, options.closed), turned_round(options), spans);
  for (std::size_t i = 0; i < here.size(); ++i)
    if (std::abs(here[i] - there[i]) > kRounding * (std::abs(here[i]) + std::abs(there[i])))
      return there[i] > here[i];
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
