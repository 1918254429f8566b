#include "keyline/lac/g2/spline_local.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/hermite.h"

namespace keyline::lac::detail {
namespace {

using core::Point2;

/// No tangent is further than this from a chord at its point: beyond, a span would have to loop.
constexpr double kWidest = 0.6 * core::kPi;

/// Directions at the points: the turn at a point is shared between its spans as their lengths are;
/// at a free end the span is symmetric.
std::vector<double> directions(std::span<const Point2> points, const SplineOptions& options) {
  const std::size_t slots = points.size();
  const std::size_t spans = options.closed ? slots : slots - 1;
  const auto chord = [&](std::size_t i) { return points[(i + 1) % slots] - points[i % slots]; };
  std::vector<double> direction(slots, 0);
  for (std::size_t i = 0; i < slots; ++i) {
    if (!options.closed && (i == 0 || i == spans)) continue;
    const auto before = chord((i + spans - 1) % spans);
    const auto after = chord(i);
    const double share = norm(before) / (norm(before) + norm(after));
    const double turn = core::angle_between(before, after);
    const double least = std::max(0.0, std::abs(turn) - kWidest);
    const double at_first = std::clamp(share * std::abs(turn), least, std::max(least, kWidest));
    direction[i] = core::direction_of(before) + std::copysign(at_first, turn);
  }
  if (options.closed) return direction;
  const double first = core::direction_of(chord(0));
  const double last = core::direction_of(chord(spans - 1));
  const auto mirrored = [](double axis, double other) {
    return axis - core::wrap_angle(other - axis);
  };
  direction[0] =
      options.start.direction.value_or(spans > 1 ? mirrored(first, direction[1]) : first);
  direction[spans] =
      options.end.direction.value_or(spans > 1 ? mirrored(last, direction[spans - 1]) : last);
  return direction;
}

/// Curvature at each point: the mean of what the clothoids of the two spans beside it have there.
std::vector<double> curvatures(std::span<const Point2> points, const SplineOptions& options,
                               const std::vector<double>& direction) {
  const std::size_t slots = points.size();
  const std::size_t spans = options.closed ? slots : slots - 1;
  std::vector<double> sum(slots, 0);
  std::vector<double> weight(slots, 0);
  for (std::size_t i = 0; i < spans; ++i) {
    const std::size_t j = (i + 1) % slots;
    const auto s = solve_g1_directions({points[i], direction[i]}, {points[j], direction[j]}, -1);
    if (!s) continue;
    // A short span knows the curvature at its end better.
    const double w = 1 / s->segment.length;
    sum[i] += w * s->segment.curvature_start;
    sum[j] += w * s->segment.curvature_end;
    weight[i] += w;
    weight[j] += w;
  }
  for (std::size_t i = 0; i < slots; ++i) sum[i] = weight[i] > 0 ? sum[i] / weight[i] : 0;
  if (!options.closed) {
    sum.front() = options.start.curvature.value_or(sum.front());
    sum.back() = options.end.curvature.value_or(sum.back());
  }
  return sum;
}

/// All spans for themselves, between given directions and curvatures.
core::Result<SplineSolution> solve_spans(std::span<const Point2> points,
                                         const std::vector<double>& wanted,
                                         const std::vector<double>& direction,
                                         const std::vector<double>& curvature,
                                         const SplineStart& asked) {
  SplineSolution solution;
  solution.span_by_span = true;
  solution.chain.start = {points[0], direction[0]};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::size_t j = (i + 1) % points.size();
    const CurvatureElement start{{points[i], direction[i]}, curvature[i]};
    const CurvatureElement end{{points[j], direction[j]}, curvature[j]};
    const auto part = solve_span(start, end, wanted[i]);
    if (!part) {
      const std::string at = std::to_string(asked.span(i));
      return core::fail(core::ErrorCode::not_converged,
                        "no curve without loops was found in span " + at, "add a point there",
                        "points[" + at + "]");
    }
    if (part->overridden) solution.overridden.push_back(i);
    for (const Piece& piece : part->chain.pieces) {
      solution.chain.pieces.push_back(piece);
      solution.span.push_back(i);
    }
  }
  return solution;
}

/// Whether a joint turns on a thousandth of the span, which neither end asks for: slopes next to 0
/// change the sign of curvature in no other way, and some beside 1 wind into a point.
bool has_needle(const Chain& chain, const CurvatureElement& start, const CurvatureElement& end) {
  const double allowed =
      std::max({kWildCurvature / distance(start.pose.position, end.pose.position),
                std::abs(start.curvature), std::abs(end.curvature)});
  return std::any_of(chain.pieces.begin(), chain.pieces.end(),
                     [&](const Piece& p) { return !(std::abs(p.curvature_start) <= allowed); });
}

}  // namespace

core::Result<SpanCurve> solve_span(const CurvatureElement& start, const CurvatureElement& end,
                                   double wanted) {
  auto found = solve_g2(start, end, wanted);
  if (wanted != -1 && (found ? has_needle(found->chain, start, end)
                             : found.error().code != core::ErrorCode::bad_input)) {
    if (auto calm = solve_g2(start, end, -1)) return SpanCurve{std::move(calm->chain), true};
  }
  if (!found) return std::unexpected(found.error());
  return SpanCurve{std::move(found->chain), false};
}

double deviation_of(std::span<const Point2> points, const SplineSolution& solution) {
  double largest = 0;
  const auto poses = joints(solution.chain);
  for (std::size_t k = 1; k < poses.size(); ++k) {
    if (k < solution.span.size() && solution.span[k] == solution.span[k - 1]) continue;
    const Point2 point = points[(solution.span[k - 1] + 1) % points.size()];
    largest = std::max(largest, distance(poses[k].position, point));
  }
  return largest;
}

core::Result<SplineSolution> solve_spline_span_by_span(std::span<const Point2> points,
                                                       const SplineOptions& options,
                                                       const std::vector<double>& wanted,
                                                       const SplineStart& asked) {
  const auto direction = directions(points, options);
  const auto curvature = curvatures(points, options, direction);
  core::Result<SplineSolution> solution;
  // Flatter at the points where they are too sharp for what is between.
  for (const double share : {1.0, 0.5, 0.2}) {
    std::vector<double> softened = curvature;
    for (double& k : softened) k *= share;
    if (options.start.curvature) softened.front() = *options.start.curvature;
    if (options.end.curvature) softened.back() = *options.end.curvature;
    solution = solve_spans(points, wanted, direction, softened, asked);
    if (solution) break;
  }
  if (!solution) return solution;
  solution->chain.closed = options.closed;
  solution->deviation = deviation_of(points, *solution);
  return solution;
}

}  // namespace keyline::lac::detail
