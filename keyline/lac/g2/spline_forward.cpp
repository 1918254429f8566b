#include "keyline/lac/g2/spline_forward.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/g2/spline_local.h"
#include "keyline/lac/g2/spline_newton.h"
#include "keyline/lac/segment/piece_shape.h"
#include "keyline/lac/segment/slope.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point2;
using core::Vector2;
using detail::SplineProblem;
using detail::SplineStart;
using detail::SplineState;

std::string number(double x) { return core::number_text(x, 6); }

/// The request with its place and size taken away.
struct Prepared {
  SplineProblem problem;  ///< slopes -1; the ones wanted are in `wanted`
  std::vector<double> wanted;
  double unit = 1;       ///< mean chord
  double direction = 0;  ///< of the first chord
};

Prepared prepare(std::span<const Point2> points, const SplineOptions& options) {
  Prepared p;
  const std::size_t slots = points.size();
  const std::size_t spans = options.closed ? slots : slots - 1;
  const auto chord = [&](std::size_t i) { return points[(i + 1) % slots] - points[i]; };
  double sum = 0;
  for (std::size_t i = 0; i < spans; ++i) sum += norm(chord(i)) / static_cast<double>(spans);
  p.unit = sum;
  p.problem.closed = options.closed;
  p.problem.turn.assign(slots, 0);
  for (std::size_t i = 0; i < spans; ++i) {
    p.problem.chord.push_back(norm(chord(i)) / p.unit);
    if (i > 0 || options.closed) {
      const Vector2 before = chord((i + spans - 1) % spans) / p.unit;
      p.problem.turn[i] = core::angle_between(before, chord(i) / p.unit);
    }
  }
  p.problem.alpha.assign(spans, -1.0);
  p.wanted.assign(spans, options.alpha.empty() ? -1.0 : options.alpha[0]);
  if (options.alpha.size() > 1) p.wanted = options.alpha;
  p.direction = core::direction_of(chord(0));
  const double last = core::direction_of(chord(spans - 1));
  if (options.start.direction) {
    p.problem.start.angle = core::wrap_angle(p.direction - *options.start.direction);
  }
  if (options.end.direction) {
    p.problem.end.angle = core::wrap_angle(*options.end.direction - last);
  }
  if (options.start.curvature) p.problem.start.curvature = *options.start.curvature * p.unit;
  if (options.end.curvature) p.problem.end.curvature = *options.end.curvature * p.unit;
  return p;
}

double turning_of_span(const SplineProblem& problem, const SplineState& state, std::size_t i) {
  double sum = 0;
  for (const Piece& piece : pieces_of_span(problem, state, i)) {
    sum += detail::absolute_turning(piece);
  }
  return sum;
}

/// The span that turns most, for a curve that is not wild; or the first wild one.
struct Calm {
  bool calm = true;
  std::size_t span = 0;
  double largest = 0;
};
Calm calm_of(const SplineProblem& problem, const SplineState& state) {
  Calm result;
  for (std::size_t i = 0; i < problem.spans(); ++i) {
    const double turned = turning_of_span(problem, state, i);
    if (turned > result.largest) {
      result.largest = turned;
      result.span = i;
    }
    if (!(turned <= detail::kWildTurning) ||
        !(state.length[i] <= detail::kWildLength * problem.chord[i])) {
      return {false, i, turned};
    }
  }
  return result;
}

/// From the straight line, folding the polygon back step by step. share: how far it came.
bool fold_up(SplineProblem problem, SplineState& state, int& iterations, double& share) {
  SplineState here = detail::straight_state(problem);
  share = 0;
  double step = 0.25;
  while (share < 1 && step > 1e-3) {
    problem.fold = std::min(1.0, share + step);
    SplineState next = here;
    if (problem.fold <= step) next = detail::guessed_state(problem);
    if (solve_spline_newton(problem, next, iterations) && calm_of(problem, next).calm) {
      here = next;
      share = problem.fold;
      step *= 1.5;
    } else {
      step *= 0.4;
    }
  }
  state = here;
  return share >= 1;
}

/// The clothoid spline: the fast way where it leads to a calm curve, else by folding.
core::Result<SplineState> clothoid_spline(const SplineProblem& problem, const SplineStart& asked,
                                          int& iterations) {
  SplineState state = detail::guessed_state(problem);
  const bool fast = solve_spline_newton(problem, state, iterations);
  const Calm calm = calm_of(problem, state);
  if (fast && calm.calm && calm.largest < core::kPi) return state;
  SplineState folded;
  double share = 0;
  if (fold_up(problem, folded, iterations, share)) return folded;
  if (fast && calm.calm) return state;
  const std::string worst = std::to_string(asked.span(calm_of(problem, folded).span));
  return core::fail(ErrorCode::not_converged,
                    "the curve through these points becomes wild near span " + worst +
                        ": it was found only while all turns were " + number(share) +
                        " of what they are",
                    "add a point there, or move the points next to it", "points[" + worst + "]");
}

double curvature_after(const SplineState& state, std::size_t i) {
  return state.curvature[(i + 1) % state.curvature.size()];
}

/// Whether the pieces of the span keep one sign of curvature.
bool keeps_sign(const SplineProblem& problem, const SplineState& state, std::size_t i) {
  for (const Piece& piece : pieces_of_span(problem, state, i)) {
    if (!(piece.curvature_start * piece.curvature_end > 0)) return false;
  }
  return true;
}

/// Takes the slopes from -1 to `wanted`; share: how far it came.
bool bend_slopes(SplineProblem& problem, const std::vector<double>& wanted, SplineState& state,
                 int& iterations, double& share) {
  share = 0;
  double step = 1;
  while (share < 1 && step > 0.05) {
    const double next_share = std::min(1.0, share + step);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      problem.alpha[i] = next_share >= 1 ? wanted[i] : -1 + next_share * (wanted[i] + 1);
    }
    SplineState next = state;
    if (solve_spline_newton(problem, next, iterations) && calm_of(problem, next).calm) {
      state = next;
      share = next_share;
      step *= 2;
    } else {
      step *= 0.4;
    }
  }
  return share >= 1;
}

/// The tenth of the spans (one at least) in which curvature is nearest to vanishing get slope -1;
/// false where all have it already.
bool give_way(const SplineProblem& problem, const SplineState& state, std::vector<double>& wanted) {
  std::vector<std::pair<double, std::size_t>> by_ratio;
  for (std::size_t i = 0; i < problem.spans(); ++i) {
    if (wanted[i] == -1) continue;
    const double a = state.curvature[i];
    const double b = curvature_after(state, i);
    const double ratio = std::min(std::abs(a), std::abs(b)) / std::max(std::abs(a), std::abs(b));
    by_ratio.emplace_back(a * b > 0 ? ratio : 0, i);
  }
  if (by_ratio.empty()) return false;
  std::sort(by_ratio.begin(), by_ratio.end());
  for (std::size_t k = 0; k < by_ratio.size() / 10 + 1; ++k) wanted[by_ratio[k].second] = -1;
  return true;
}

/// Spans of a slope from 0 on in which the curvature has come to change sign get slope -1; false
/// where there are none.
bool give_way_at_inflections(const SplineProblem& problem, const SplineState& state,
                             std::vector<double>& wanted) {
  bool any = false;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!(wanted[i] >= 0) || keeps_sign(problem, state, i)) continue;
    wanted[i] = -1;
    any = true;
  }
  return any;
}

/// From the clothoid spline to the slopes wanted. Spans in which curvature changes sign (for slopes
/// from 0 on), then, as long as no curve is found, those in which it is nearest to vanishing keep
/// -1: `wanted` becomes what was reached.
core::Result<void> reach_slopes(SplineProblem& problem, std::vector<double>& wanted,
                                const SplineStart& asked, SplineState& state, int& iterations) {
  const SplineState clothoids = state;
  give_way_at_inflections(problem, clothoids, wanted);
  double share = 0;
  for (int round = 0; round < 40; ++round) {
    state = clothoids;
    if (bend_slopes(problem, wanted, state, iterations, share)) {
      if (!give_way_at_inflections(problem, state, wanted)) return {};
    } else if (!give_way(problem, state, wanted)) {
      break;
    }
  }
  const auto far = std::max_element(wanted.begin(), wanted.end(), [](double a, double b) {
    return std::abs(a + 1) < std::abs(b + 1);
  });
  const std::size_t at = asked.span(static_cast<std::size_t>(far - wanted.begin()));
  return core::fail(ErrorCode::not_converged,
                    "no curve of these slopes was found; on the way from slope -1 the last was " +
                        number(-1 + share * (*far + 1)) + " in span " + std::to_string(at),
                    "use a slope up to " + number(-1 + share * (*far + 1)), "alpha");
}

/// End of a piece by the solver's own kernel, which is faster than end_pose.
core::Pose2 after_piece(const core::Pose2& at, const Piece& p) {
  const auto shape =
      detail::piece_shape(p.alpha, p.curvature_start * p.length, p.curvature_end * p.length,
                          detail::kFixed, detail::kFixed);
  return {at.position + p.length * core::rotate_ccw(shape.chord, at.direction),
          at.direction + shape.turning};
}

/// Largest distance of the joints, walked from the start, from the points.
double deviation_of(std::span<const Point2> points, const SplineSolution& solution) {
  double largest = 0;
  core::Pose2 at = solution.chain.start;
  for (std::size_t k = 0; k < solution.span.size(); ++k) {
    at = after_piece(at, solution.chain.pieces[k]);
    const bool ends_span = k + 1 == solution.span.size() || solution.span[k + 1] > solution.span[k];
    const Point2 wanted = points[(solution.span[k] + 1) % points.size()];
    if (ends_span) largest = std::max(largest, distance(at.position, wanted));
  }
  return largest;
}

SplineSolution assembled(std::span<const Point2> points, const Prepared& prepared,
                         const SplineState& state) {
  const SplineProblem& problem = prepared.problem;
  SplineSolution solution;
  solution.chain.pieces.reserve(problem.spans() + 2);
  solution.span.reserve(problem.spans() + 2);
  for (std::size_t i = 0; i < problem.spans(); ++i) {
    for (const Piece& p : pieces_of_span(problem, state, i)) {
      solution.chain.pieces.push_back({p.alpha, p.length * prepared.unit,
                                       p.curvature_start / prepared.unit,
                                       p.curvature_end / prepared.unit});
      solution.span.push_back(i);
    }
  }
  solution.chain.closed = problem.closed;
  detail::put_at(points[0], prepared.direction, solution);
  solution.deviation = deviation_of(points, solution);
  return solution;
}

/// One span with both conditions at both ends.
core::Result<SplineSolution> single_span(std::span<const Point2> points,
                                         const SplineOptions& options, double alpha) {
  auto span =
      detail::solve_span({{points[0], *options.start.direction}, *options.start.curvature},
                         {{points[1], *options.end.direction}, *options.end.curvature}, alpha);
  if (!span) return std::unexpected(span.error());
  SplineSolution solution;
  solution.chain = std::move(span->chain);
  solution.span.assign(solution.chain.pieces.size(), 0);
  if (span->overridden) solution.overridden = {0};
  solution.deviation = detail::deviation_of(points, solution);
  return solution;
}

bool is_straight(const SplineProblem& problem, const SplineState& state) {
  const auto flat = [](double k) { return std::abs(k) < 1e-14; };
  return std::all_of(state.curvature.begin(), state.curvature.end(), flat) &&
         flat(problem.start.curvature.value_or(0)) && flat(problem.end.curvature.value_or(0));
}

}  // namespace

void detail::put_at(const Point2& first, double direction, SplineSolution& solution) {
  core::Pose2 end;
  for (std::size_t k = 0; k < solution.span.size() && solution.span[k] == 0; ++k)
    end = after_piece(end, solution.chain.pieces[k]);
  solution.chain.start = {first, direction - core::direction_of(end.position - Point2{})};
}

core::Result<SplineSolution> detail::solve_spline_forward(std::span<const Point2> points,
                                                          const SplineOptions& options,
                                                          const SplineStart& asked) {
  const std::size_t spans = options.closed ? points.size() : points.size() - 1;
  Prepared prepared = prepare(points, options);
  SplineProblem& problem = prepared.problem;
  if (spans == 1 && problem.start.both() && problem.end.both()) {
    return single_span(points, options, prepared.wanted[0]);
  }
  int iterations = 0;
  auto state = clothoid_spline(problem, asked, iterations);
  if (!state) {
    auto local = detail::solve_spline_span_by_span(points, options, prepared.wanted, asked);
    return local ? local : std::unexpected(state.error());
  }
  std::vector<double> reached = prepared.wanted;
  if (is_straight(problem, *state)) {
    std::fill(state->curvature.begin(), state->curvature.end(), 0.0);
    problem.alpha = reached;
  } else if (std::any_of(reached.begin(), reached.end(), [](double a) { return a != -1; })) {
    const auto ok = reach_slopes(problem, reached, asked, *state, iterations);
    if (!ok) return std::unexpected(ok.error());
  }
  SplineSolution solution = assembled(points, prepared, *state);
  solution.iterations = iterations;
  for (std::size_t i = 0; i < spans; ++i) {
    if (reached[i] != prepared.wanted[i]) solution.overridden.push_back(i);
  }
  if (const auto valid = validate(solution.chain); !valid) {
    return core::fail(ErrorCode::not_converged, "no sound curve of these slopes was found",
                      "use slopes nearer to -1", "alpha");
  }
  return solution;
}

}  // namespace keyline::lac
