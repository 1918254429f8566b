#include "keyline/fairing/run.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"
#include "keyline/fairing/band.h"
#include "keyline/fairing/calm_run.h"
#include "keyline/fairing/condense.h"
#include "keyline/fairing/exact_chain.h"
#include "keyline/fairing/flat_pieces.h"
#include "keyline/fairing/guides.h"
#include "keyline/fairing/residuals.h"
#include "keyline/fairing/run_again.h"
#include "keyline/fairing/run_frame.h"
#include "keyline/fairing/run_points.h"
#include "keyline/fairing/settle.h"
#include "keyline/fairing/shortest_run.h"
#include "keyline/fairing/straight_run.h"
#include "keyline/fairing/stretches.h"
#include "keyline/fairing/turns.h"

namespace keyline::fairing::detail {
namespace {

// Of a run whose points lie a hair outside or which passes a border: each takes off what that is.
constexpr int kTightenings = 5;
constexpr double kRateShare = 0.999;  // of a limit on rates: the rest is for what closes the chain
constexpr double kFar = 1.3;          // of the tolerance: farther off is no matter of rounding
constexpr double kHeights = 16;       // turn times length over an arc's height over a line, twice

/// Whether nothing is asked of a run but to pass its points.
bool is_plain(const Run& run, const RunOptions& options) {
  const bool held = run.clamp_start != Clamp::none || run.clamp_end != Clamp::none ||
                    run.tie_start || run.tie_end || run.axis;
  return !run.closed && !held && options.pieces == 0;
}

/// Whether the slopes of bent pieces are in the range asked for.
bool within_slopes(const FitChain& chain, const RunOptions& options) {
  return std::ranges::all_of(chain.pieces, [&](const FitPiece& piece) {
    return piece.kind != PieceKind::curve ||
           (options.slopes.low <= piece.alpha && piece.alpha <= options.slopes.high);
  });
}

/// A single piece that reproduces the points, which may be so few that an estimate of their noise
/// is one of their spacing.
std::optional<FitChain> piece_at_sight(const std::vector<FitPoint>& points,
                                       const RunOptions& options) {
  if (points.size() < kPiecePoints || points.size() > kTellingPoints) return std::nullopt;
  if (options.max_rate) return std::nullopt;
  auto found = one_exact_piece(points, false, exactness({}));
  return found && within_slopes(*found, options) ? std::move(found) : std::nullopt;
}

/// Points on a line, an arc or a single piece need no search.
bool solve_at_sight(RunResult& result, const Run& run, const RunOptions& options) {
  if (!is_plain(run, options)) return false;
  auto found = straight_chain(result.points);
  if (!found && run.inside.empty()) found = arc_chain(result.points);
  const bool straightened = found.has_value();
  if (!found && run.inside.empty()) found = piece_at_sight(result.points, options);
  if (!found) return false;
  result.fit = std::move(*found);
  result.accept = {exactness(result.accept), 0};
  result.within_tolerance = result.exact = true;
  result.start_pieces = 1;
  result.straightened = straightened ? 1 : 0;
  return true;
}

/// An arc as near to the points as the calmest curve may be, which has no variation at all. Not
/// where a line might do: those are told from arcs by their points' errors.
std::optional<FitChain> calm_arc(const RunResult& result, const Run& run, const RunOptions& options,
                                 double tolerance, const Residuals& residuals) {
  if (!is_plain(run, options) || !run.inside.empty() || !run.must_pass.empty()) return std::nullopt;
  auto arc = arc_chain(result.points, tolerance);
  if (!arc) return std::nullopt;
  const FitPiece& piece = arc->pieces[0];
  const double turn = std::abs(arc->joints[0].curvature) * piece.length;
  if (turn * piece.length < kHeights * tolerance) return std::nullopt;
  double sum = 0, weights = 0;
  const std::vector<double> off = offsets(*arc, result.points);
  for (std::size_t i = 0; i < off.size(); ++i) {
    sum += result.points[i].weight * off[i] * off[i];
    weights += result.points[i].weight;
  }
  if (sum > weights * std::pow(residuals.most(0), 2)) return std::nullopt;
  return arc;
}

void take_arc(RunResult& result, FitChain arc, std::vector<FitPoint> points) {
  result.fit = std::move(arc);
  result.points = std::move(points);
  result.dense = {};
  result.within_tolerance = true;
  result.start_pieces = result.straightened = 1;
}

/// The curve of least variation in the tolerance, in log-aesthetic pieces.
void solve_least_variation(RunResult& result, const Run& run, const RunFrame& frame,
                           const curve::BSpline2& spline, const RunOptions& options) {
  const double tolerance = kBandShare * result.accept.tolerance;
  take_calm_points(result, run, frame, tolerance);
  const Residuals residuals = allowed_residuals(result.points, run.closed, run.points.size(),
                                                result.accept.noise, tolerance, options.smoothness);
  auto arc = calm_arc(result, run, options, tolerance, residuals);
  std::vector<FitPoint> measured = result.points;
  result.points = with_guides(cut_digits(result.points), run.closed, tolerance);
  std::vector<double> weights;  // of points to be passed: here they count as others do
  for (FitPoint& p : result.points)
    if (p.must_pass) weights.push_back(std::exchange(p.weight, 1));
  CalmRunOptions calm;
  calm.start = held_end(run, frame, spline, true);
  calm.end = held_end(run, frame, spline, false);
  reach_axis(result.points, calm.start, calm.end, tolerance);
  watch_borders(result, run, tolerance);
  calm.tolerance = tolerance;
  calm.residuals = residuals;
  calm.slopes = options.slopes;
  calm.arcs = options.joints == JointOrder::g2;  // the rate beside an arc is never one
  calm.most_turns = options.waves;
  const double size = result.to_canonical.scale;
  if (options.max_rate) calm.most_rate = kRateShare * *options.max_rate / (size * size);
  calm.progress = options.progress;
  calm.threads = options.threads;
  calm.members = members_of(result, run, frame);
  CalmRun found = solve_calm(result.points, run.closed, calm);
  auto weight = weights.begin();
  for (FitPoint& p : result.points) {
    if (!p.must_pass) continue;
    p.weight = *weight++;
    p.share = 1 / kPassed;
  }
  // Between sparse points the solver may end at bends that no point asks for.
  if (arc && found.curve.alpha.size() > 1)
    return take_arc(result, std::move(*arc), std::move(measured));
  result.fit = closed_chain(found.curve, result.points, tolerance);
  result.start_pieces = static_cast<int>(result.fit.pieces.size());
  result.dense = std::move(found.curve);
  result.spring = found.band.spring;
  result.waves = found.waves;
  result.within_tolerance = found.band.within;
}

/// The shortest chain in place of the calmest, which was missed; whether smoothness counted is its.
void stand_in(RunResult& result, RunResult shortest) {
  shortest.spring = result.spring;
  shortest.calm_missed = true;
  result = std::move(shortest);
}

/// By what the points are and what is asked for: a line or an arc, the chain that reproduces them,
/// the calmest one. The shortest where that or a number of pieces is asked for, or where the
/// calmest did not come out within the tolerance, which is told.
void solve_one_way(RunResult& result, const Run& run, const RunFrame& frame,
                   const curve::BSpline2& spline, const RunOptions& options) {
  if (solve_at_sight(result, run, options)) return;
  if (options.criterion == Criterion::least_variation && options.pieces == 0) {
    RunResult exact = result;
    if (!options.max_rate && solve_exact(exact, run, frame, spline, options) &&
        stays_inside(exact, run) && within_slopes(exact.fit, options)) {
      result = std::move(exact);
      return;
    }
    RunResult shortest = result;
    solve_least_variation(result, run, frame, spline, options);
    const bool stays = result.dense.joints.empty() ||
                       !wanders(result.dense, result.points, result.accept.tolerance);
    if ((result.within_tolerance && stays) || options.progress.stop_requested()) return;
    if (options.max_rate) return;  // a limit comes before the tolerance
    solve_shortest(shortest, run, frame, spline, options);
    result.missed = !shortest.within_tolerance;
    if (result.missed) {
      if (winds(result, run) && !winds(shortest, run)) result = std::move(shortest);
      return;
    }
    stand_in(result, std::move(shortest));
    return;
  }
  options.pieces > 0 ? solve_counted(result, run, frame, spline, options)
                     : solve_shortest(result, run, frame, spline, options);
}

/// The run solved for a tolerance, whether or not every single point passes in the end.
RunResult solved_run(const Run& run, const curve::BSpline2& spline, const RunOptions& options) {
  const RunFrame frame = make_frame(run);
  RunResult result;
  result.to_canonical = frame.to_canonical;
  result.reversed = frame.reversed;
  take_points(result, run, frame, kMostFitPoints);
  result.accept = acceptance_of(run, options);
  solve_one_way(result, run, frame, spline, options);
  result.point_of.resize(run.points.size());
  const std::vector<std::size_t> held = holders(result, frame);
  for (std::size_t j = 0; j < frame.order.size(); ++j) result.point_of[frame.order[j]] = held[j];
  if (!winds(result, run)) result.chain = lay_out(result.fit, result.to_canonical, result.reversed);
  return result;
}

/// Where points lie a hair outside after pieces have met, the same pieces with that much less room.
/// Returns the largest offset then.
double draw_in(RunResult& result, const Run& run, const curve::BSpline2& spline,
               const RunOptions& options) {
  double share = 1;
  double most = largest_offset(result, run);
  for (int round = 0; round < kTightenings && !options.progress.stop_requested(); ++round) {
    if (most <= options.tolerance || most > kFar * options.tolerance) break;
    share *= 0.998 * options.tolerance / most;
    RunResult again = result;
    if (!solve_again(again, run, spline, share) || largest_offset(again, run) >= most) {
      RunOptions tighter = options;
      tighter.tolerance *= share;
      again = solved_run(run, spline, tighter);
    }
    const double now = largest_offset(again, run);
    if (!(now < most)) continue;
    result = std::move(again);
    most = now;
  }
  return most;
}

/// Where the chain passes a border, the same pieces with that much margin; where these cannot keep
/// it, other pieces.
void bring_inside(RunResult& result, const Run& run, const curve::BSpline2& spline,
                  const RunOptions& options) {
  Run drawn = run;
  for (int round = 0; round < kTightenings && !options.progress.stop_requested(); ++round) {
    const double most = passed_most(result, run);
    if (most == 0) return;
    add_margin(drawn, result);
    RunResult again = result;
    if (!solve_inside(again, drawn, spline) || passed_most(again, run) >= most) {
      again = solved_run(drawn, spline, options);
      if (again.dense.joints.empty() || winds(again, run)) return;
    }
    if (passed_most(again, run) < most && largest_offset(again, run) <= options.tolerance)
      result = std::move(again);
  }
}

/// The calmest chain in the tolerance and inside what bounds it, as nearly as its pieces come
/// there; the shortest, where it leaves a point outside in the end.
void keep_tolerance(RunResult& result, const Run& run, const curve::BSpline2& spline,
                    RunOptions options) {
  double most = draw_in(result, run, spline, options);
  bring_inside(result, run, spline, options);
  if (!run.inside.empty()) most = largest_offset(result, run);
  if (options.progress.stop_requested() || options.max_rate || most <= options.tolerance) return;
  if (result.missed) return;
  options.criterion = Criterion::fewest_pieces;
  RunResult shortest = fair_run(run, spline, options);
  if (largest_offset(shortest, run) > options.tolerance) return;
  stand_in(result, std::move(shortest));
}

}  // namespace

bool winds(const RunResult& result, const Run& run) {
  return !(turned(result.fit) <= core::kPi * static_cast<double>(run.points.size() + 1));
}

RunResult fair_run(const Run& run, const curve::BSpline2& spline, const RunOptions& options) {
  RunResult result = solved_run(run, spline, options);
  if (winds(result, run)) return result;
  if (!result.dense.joints.empty()) {
    keep_tolerance(result, run, spline, options);
    return result;
  }
  if (run.points.size() <= kMostFitPoints || !result.within_tolerance || options.pieces > 0)
    return result;
  // Means of points tell their spread about the curve only nearly.
  const double most = largest_offset(result, run);
  if (most <= options.tolerance) return result;
  RunOptions tighter = options;
  tighter.tolerance *= 0.99 * options.tolerance / most;
  RunResult again = solved_run(run, spline, tighter);
  return largest_offset(again, run) < most ? again : result;
}

namespace {

/// Whether pieces that were chosen for free ends are calm no longer where these are tied.
bool strained(const RunResult& tied, const RunResult& loose) {
  const double unseen = unseen_energy(loose.dense.length, loose.accept.tolerance);
  return variation(tied.dense) > kWaveWorth * std::max(variation(loose.dense), unseen);
}

/// A wave more has to take off what it is worth.
bool calmer(const RunResult& a, const RunResult& b) {
  const int more = seen_waves(a.dense) - seen_waves(b.dense);
  return variation(a.dense) * std::pow(kWaveWorth, more) < variation(b.dense);
}

/// Other pieces for the tied ends where these are calmer; whether they are taken.
bool choose_anew(RunResult& result, const Run& run, const curve::BSpline2& spline,
                 const RunOptions& options) {
  RunResult other = fair_run(run, spline, options);
  if (other.dense.joints.empty() || !other.within_tolerance || winds(other, run)) return false;
  if (!calmer(other, result)) return false;
  result = std::move(other);
  return true;
}

}  // namespace

void tie_ends(RunResult& result, const RunResult* moved, const Run& run,
              const curve::BSpline2& spline, const RunOptions& options) {
  const RunFrame frame = make_frame(run);
  const RunResult loose = result;
  const auto tie = [](FitJoint& joint, Hold& hold, const HeldEnd& end) {
    if (end.hold == Hold::free) return;
    joint.position = end.joint.position;
    hold = std::max(hold, end.hold);
  };
  if (!result.dense.joints.empty()) {
    if (moved)
      result = *moved;
    else
      result.within_tolerance = solve_again(result, run, spline, 1);
    if (!result.within_tolerance) {
      result = fair_run(run, spline, options);
      if (winds(result, run)) result = loose;
      return;
    }
    if (strained(result, loose) && choose_anew(result, run, spline, options)) return;
    keep_tolerance(result, run, spline, options);
    return;
  }
  FitChain& chain = result.fit;
  tie(chain.joints.front(), chain.hold_start, held_end(run, frame, spline, true));
  tie(chain.joints.back(), chain.hold_end, held_end(run, frame, spline, false));
  result.within_tolerance = polish(chain, result.points, result.accept, result.exact);
  RunResult other;
  if (!result.within_tolerance && loose.within_tolerance) other = fair_run(run, spline, options);
  if (!other.chain.pieces.empty())
    result = std::move(other);
  else
    result.chain = lay_out(chain, result.to_canonical, result.reversed);
}

}  // namespace keyline::fairing::detail
