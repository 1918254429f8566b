#include "keyline/fairing/shortest_run.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>

#include "keyline/fairing/chain_edit.h"
#include "keyline/fairing/condense.h"
#include "keyline/fairing/exact_chain.h"
#include "keyline/fairing/guides.h"
#include "keyline/fairing/run_again.h"
#include "keyline/fairing/settle.h"
#include "keyline/fairing/stretches.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kLoose = 5e-4;   // of the length
constexpr double kExactRoom = 5;  // a tolerance within which rounding is no matter, in its units

/// A number cut to seven digits, see cut_digits.
double rounded(double x) {
  int exponent = 0;
  const double share = std::frexp(x, &exponent);
  return std::ldexp(std::round(share * 0x1p24), exponent - 24);
}

ChainSearchOptions search_options(const Run& run, const RunFrame& frame,
                                  const curve::BSpline2& spline, const RunOptions& options) {
  ChainSearchOptions search;
  search.accept = acceptance_of(run, options);
  search.wanted_pieces = options.pieces;
  search.start = held_end(run, frame, spline, true);
  search.end = held_end(run, frame, spline, false);
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
  const ChainSearchOptions searching = search_options(run, frame, spline, options);
  ChainSearchResult search = search_chain(points, run.closed, searching);
  const bool found = search.within_tolerance;
  const bool first = attempt.share > 0.95 && !attempt.any_trend;
  std::vector<std::size_t> all(measured.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (first && finish_exact(result, search, measured, all, run, searching)) return false;
  finish(result, std::move(search), std::move(points), options.pieces == 0);
  return found && !result.within_tolerance;
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

/// See solve_exact.
void seek_exact(RunResult& result, const Run& run, const RunFrame& frame,
                const curve::BSpline2& spline, RunOptions options) {
  options.tolerance = std::max(options.tolerance, kLoose * run.length);
  const std::vector<std::size_t> taken = telling_points(result.points);
  const std::vector<FitPoint> points =
      with_guides(cut_digits(chosen(result.points, taken)), run.closed,
                  rounded(options.tolerance / run.length));
  const ChainSearchOptions searching = search_options(run, frame, spline, options);
  const std::vector<FitPoint> measured = result.points;
  finish_exact(result, exact_search(points, run, searching), measured, taken, run, searching);
}

/// See solve_shortest.
void seek_shortest(RunResult& result, const Run& run, const RunFrame& frame,
                   const curve::BSpline2& spline, const RunOptions& options) {
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

/// Seeks it where it was not found before.
void once(Sought sought, RunResult& result, const Run& run, const RunOptions& options,
          const std::function<void()>& seek) {
  if (options.before)
    if (auto found = options.before->find(sought, run, options.tolerance)) {
      result = std::move(*found);
      return;
    }
  seek();
  if (options.before && !options.progress.stop_requested())
    options.before->keep(sought, run, options.tolerance, result);
}

/// Whether the shortest chains are the same ones.
bool alike(const Run& a, const Run& b) {
  const auto of = [](const Run& run) {
    return std::tie(run.points, run.weights, run.must_pass, run.closed, run.clamp_start,
                    run.clamp_end, run.tie_start, run.tie_end, run.axis, run.start_on_axis,
                    run.end_on_axis, run.members);
  };
  return of(a) == of(b);
}

}  // namespace

std::optional<RunResult> FoundBefore::find(Sought sought, const Run& run, double tolerance) const {
  const std::scoped_lock lock(mutex_);
  for (const Found& one : found_)
    if (one.sought == sought && one.tolerance == tolerance && alike(one.run, run))
      return one.result;
  return std::nullopt;
}

void FoundBefore::keep(Sought sought, const Run& run, double tolerance, const RunResult& result) {
  const std::scoped_lock lock(mutex_);
  found_.push_back({sought, run, tolerance, result});
}

Acceptance acceptance_of(const Run& run, const RunOptions& options) {
  // A little less than the tolerance, for what the cut digits may move.
  return {rounded((1 - 1e-6) * options.tolerance / run.length),
          rounded(options.noise / run.length)};
}

bool solve_exact(RunResult& result, const Run& run, const RunFrame& frame,
                 const curve::BSpline2& spline, const RunOptions& options) {
  if (run.axis || !may_reproduce(result, run)) return false;
  once(Sought::exact, result, run, options,
       [&] { seek_exact(result, run, frame, spline, options); });
  return result.exact;
}

void solve_shortest(RunResult& result, const Run& run, const RunFrame& frame,
                    const curve::BSpline2& spline, const RunOptions& options) {
  once(Sought::shortest, result, run, options,
       [&] { seek_shortest(result, run, frame, spline, options); });
}

void solve_counted(RunResult& result, const Run& run, const RunFrame& frame,
                   const curve::BSpline2& spline, const RunOptions& options) {
  const auto wanted = static_cast<std::size_t>(options.pieces);
  RunOptions fewest = options;
  fewest.pieces = 0;
  RunResult shortest = result;
  solve_shortest(shortest, run, frame, spline, fewest);
  if (!shortest.within_tolerance || shortest.fit.pieces.size() > wanted)
    return seek_shortest(result, run, frame, spline, options);
  shortest.fit = parted(shortest.fit, wanted);
  result = std::move(shortest);
}

}  // namespace keyline::fairing::detail
