#include "keyline/fairing/run.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"
#include "keyline/fairing/calm_run.h"
#include "keyline/fairing/chain_edit.h"
#include "keyline/fairing/condense.h"
#include "keyline/fairing/exact_chain.h"
#include "keyline/fairing/guides.h"
#include "keyline/fairing/residuals.h"
#include "keyline/fairing/run_again.h"
#include "keyline/fairing/run_frame.h"
#include "keyline/fairing/run_points.h"
#include "keyline/fairing/settle.h"
#include "keyline/fairing/straight_run.h"
#include "keyline/fairing/stretches.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kTightenings = 5;
constexpr double kRateShare = 0.999;  // of a limit on rates: the rest is for what closes the chain
constexpr double kLoose = 5e-4;       // of the length
constexpr double kExactRoom = 5;  // a tolerance within which rounding is no matter, in its units
constexpr double kFar = 1.3;      // of the tolerance: farther off is no matter of rounding
constexpr double kPassed = 1e3;   // a point to be passed is off by so much less than others may

/// A number cut to seven digits, see cut_digits.
double rounded(double x) {
  int exponent = 0;
  const double share = std::frexp(x, &exponent);
  return std::ldexp(std::round(share * 0x1p24), exponent - 24);
}

ChainSearchOptions search_options(const Run& run, const RunOptions& options) {
  ChainSearchOptions search;
  // A little less than the tolerance, for what the cut digits may move.
  search.accept = {rounded((1 - 1e-6) * options.tolerance / run.length),
                   rounded(options.noise / run.length)};
  search.wanted_pieces = options.pieces;
  search.threads = options.threads;
  search.progress = options.progress;
  return search;
}

/// One search, polished.
struct Attempt {
  double share = 1;        ///< of the tolerance that is searched for
  bool any_trend = false;  ///< offsets that show more than noise are let pass
};

std::vector<FitPoint> chosen(const std::vector<FitPoint>& points,
                             const std::vector<std::size_t>& taken) {
  std::vector<FitPoint> found;
  for (const std::size_t i : taken) found.push_back(points[i]);
  return found;
}

/// Takes over what a search found for `points`, straightened and polished.
void finish(RunResult& result, ChainSearchResult search, std::vector<FitPoint> points,
            bool straightening) {
  result.points = std::move(points);
  for (std::size_t j = 0; j < result.points.size(); ++j)
    result.points[j].weight = search.weights[j];
  const bool found = search.within_tolerance;
  result.fit = std::move(search.chain);
  result.start_pieces = search.start_pieces;
  if (found && straightening)
    result.straightened = straighten(result.fit, result.points, result.accept);
  result.within_tolerance = polish(result.fit, result.points, result.accept, result.exact);
}

/// The chain that reproduces the points, where there is one and its polish keeps it; else the
/// result stays as it is. The search was for points `taken` of them.
bool finish_exact(RunResult& result, ChainSearchResult search,
                  const std::vector<FitPoint>& measured, const std::vector<std::size_t>& taken,
                  const Run& run, const ChainSearchOptions& searching) {
  if (!find_exact(search, chosen(measured, taken), run.closed, searching)) return false;
  RunResult exact = result;
  exact.exact = true;
  exact.accept = {exactness(result.accept), 0};
  if (!follows_all(search, taken, measured, exact.accept.tolerance)) return false;
  finish(exact, std::move(search), measured, searching.wanted_pieces == 0);
  if (exact.within_tolerance) result = std::move(exact);
  return result.exact;
}

/// Returns whether the search found a chain and its polish did not keep it: a tighter one may stay.
bool solve_once(RunResult& result, const std::vector<FitPoint>& measured, const Run& run,
                const RunFrame& frame, const curve::BSpline2& spline, RunOptions options,
                Attempt attempt) {
  options.tolerance *= attempt.share;
  if (attempt.any_trend) options.noise = result.accept.noise = 0;
  std::vector<FitPoint> points =
      with_guides(cut_digits(measured), run.closed, rounded(options.tolerance / run.length));
  ChainSearchOptions searching = search_options(run, options);
  searching.start = held_end(run, frame, spline, true);
  searching.end = held_end(run, frame, spline, false);
  ChainSearchResult search = search_chain(points, run.closed, searching);
  const bool found = search.within_tolerance;
  const bool first = attempt.share > 0.95 && !attempt.any_trend;
  std::vector<std::size_t> all(measured.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (first && finish_exact(result, search, measured, all, run, searching)) return false;
  finish(result, std::move(search), std::move(points), options.pieces == 0);
  return found && !result.within_tolerance;
}

/// Points on a line need no search, unless more is asked of the run than to pass them.
bool solve_straight(RunResult& result, const Run& run, const RunOptions& options) {
  const bool held = run.clamp_start != Clamp::none || run.clamp_end != Clamp::none ||
                    run.tie_start || run.tie_end || run.axis;
  if (run.closed || held || options.pieces > 0) return false;
  auto line = straight_chain(result.points);
  if (!line) return false;
  result.fit = std::move(*line);
  result.accept = {exactness(result.accept), 0};
  result.within_tolerance = result.exact = true;
  result.start_pieces = result.straightened = 1;
  return true;
}

/// The search, once more with a tighter tolerance where polishing loses what it had found; and
/// where errors that are no noise (traced pixels) leave trends with any chain, without regard to
/// them.
void solve(RunResult& result, const Run& run, const RunFrame& frame, const curve::BSpline2& spline,
           const RunOptions& options) {
  const std::vector<FitPoint> measured = result.points;
  const bool trends_count = noisy(result.accept);
  for (const bool any_trend : {false, true}) {
    if (any_trend && !trends_count) return;
    for (const double share : {0.98, 0.9, 0.8}) {
      const bool again =
          solve_once(result, measured, run, frame, spline, options, {share, any_trend});
      if (!again || options.pieces > 0 || options.progress.stop_requested()) break;
    }
    if (result.within_tolerance || options.pieces > 0 || options.progress.stop_requested()) return;
  }
}

/// As many pieces as are wanted: the shortest chain with its longest pieces parted, or merged from
/// many where fewer are wanted, which leaves the tolerance.
void solve_counted(RunResult& result, const Run& run, const RunFrame& frame,
                   const curve::BSpline2& spline, const RunOptions& options) {
  const auto wanted = static_cast<std::size_t>(options.pieces);
  RunOptions fewest = options;
  fewest.pieces = 0;
  RunResult shortest = result;
  solve(shortest, run, frame, spline, fewest);
  if (!shortest.within_tolerance || shortest.fit.pieces.size() > wanted)
    return solve(result, run, frame, spline, options);
  shortest.fit = parted(shortest.fit, wanted);
  result = std::move(shortest);
}

/// Whether rounding is small beside the tolerance and single pieces follow most of the points.
bool may_reproduce(const RunResult& result, const Run& run) {
  const double exact = exactness(result.accept);
  return kExactRoom * exact <= result.accept.tolerance &&
         may_be_exact(result.points, run.closed, exact);
}

/// A single piece where that reproduces the points, else what the search finds.
ChainSearchResult exact_search(const std::vector<FitPoint>& points, const Run& run,
                               const ChainSearchOptions& searching) {
  const bool held = searching.start.hold != Hold::free || searching.end.hold != Hold::free;
  auto piece =
      held ? std::nullopt : one_exact_piece(points, run.closed, exactness(searching.accept));
  if (!piece) return search_chain(points, run.closed, searching);
  ChainSearchResult found;
  found.chain = std::move(*piece);
  found.weights.assign(points.size(), 1);
  found.within_tolerance = true;
  found.start_pieces = 1;
  return found;
}

/// Points that a chain reproduces to rounding get that chain, whatever the tolerance allows.
/// The search begins with few pieces, as a loose tolerance gives them, and with no more points than
/// tell them.
bool solve_exact(RunResult& result, const Run& run, const RunFrame& frame,
                 const curve::BSpline2& spline, RunOptions options) {
  if (run.axis || !may_reproduce(result, run)) return false;
  options.tolerance = std::max(options.tolerance, kLoose * run.length);
  const std::vector<std::size_t> taken = telling_points(result.points);
  const std::vector<FitPoint> points =
      with_guides(cut_digits(chosen(result.points, taken)), run.closed,
                  rounded(options.tolerance / run.length));
  ChainSearchOptions searching = search_options(run, options);
  searching.start = held_end(run, frame, spline, true);
  searching.end = held_end(run, frame, spline, false);
  const std::vector<FitPoint> measured = result.points;
  return finish_exact(result, exact_search(points, run, searching), measured, taken, run,
                      searching);
}

/// The curve of least variation in the tolerance, in log-aesthetic pieces.
void solve_least_variation(RunResult& result, const Run& run, const RunFrame& frame,
                           const curve::BSpline2& spline, const RunOptions& options) {
  const double tolerance = kBandShare * result.accept.tolerance;
  take_calm_points(result, run, frame, tolerance);
  const Residuals residuals = allowed_residuals(result.points, run.closed, run.points.size(),
                                                result.accept.noise, tolerance, options.smoothness);
  result.points = with_guides(cut_digits(result.points), run.closed, tolerance);
  for (FitPoint& p : result.points)
    if (p.must_pass) p.share = kPassed;
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
  calm.members = members_of(result, run, frame);
  CalmRun found = solve_calm(result.points, run.closed, calm);
  result.fit = closed_chain(found.curve, result.points, tolerance);
  result.start_pieces = static_cast<int>(result.fit.pieces.size());
  result.dense = std::move(found.curve);
  result.spring = found.band.spring;
  result.waves = found.waves;
  result.within_tolerance = found.band.within;
}

/// By what the points are and what is asked for: a line, the chain that reproduces them, the
/// calmest one. The shortest where that or a number of pieces is asked for, or where the calmest
/// did not come out within the tolerance, which is told.
void solve_one_way(RunResult& result, const Run& run, const RunFrame& frame,
                   const curve::BSpline2& spline, const RunOptions& options) {
  if (solve_straight(result, run, options)) return;
  if (options.criterion == Criterion::least_variation && options.pieces == 0) {
    RunResult exact = result;
    if (!options.max_rate && solve_exact(exact, run, frame, spline, options) &&
        stays_inside(exact, run)) {
      result = std::move(exact);
      return;
    }
    RunResult shortest = result;
    solve_least_variation(result, run, frame, spline, options);
    const bool stays = !wanders(result.dense, result.points, result.accept.tolerance);
    if ((result.within_tolerance && stays) || options.progress.stop_requested()) return;
    if (options.max_rate) return;  // a limit comes before the tolerance
    solve(shortest, run, frame, spline, options);
    result.missed = !shortest.within_tolerance;
    if (result.missed) {
      if (winds(result, run) && !winds(shortest, run)) result = std::move(shortest);
      return;
    }
    result = std::move(shortest);
    result.calm_missed = true;
    return;
  }
  options.pieces > 0 ? solve_counted(result, run, frame, spline, options)
                     : solve(result, run, frame, spline, options);
}

/// The run solved for a tolerance, whether or not every single point passes in the end.
RunResult solved_run(const Run& run, const curve::BSpline2& spline, const RunOptions& options) {
  const RunFrame frame = make_frame(run);
  RunResult result;
  result.to_canonical = frame.to_canonical;
  result.reversed = frame.reversed;
  take_points(result, run, frame, kMostFitPoints);
  result.accept = search_options(run, options).accept;
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
  result = std::move(shortest);
  result.calm_missed = true;
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
