#include "keyline/fairing/run.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"
#include "keyline/fairing/condense.h"
#include "keyline/fairing/run_frame.h"
#include "keyline/fairing/settle.h"

namespace keyline::fairing::detail {
namespace {

constexpr std::size_t kMostFitPoints = 1200;
constexpr double kExactness = 2e-7;  // of the length: what counts as reproduced to rounding

ChainSearchOptions search_options(const Run& run, const RunOptions& options) {
  ChainSearchOptions search;
  search.accept = {options.tolerance / run.length, options.noise / run.length};
  search.wanted_pieces = options.pieces;
  search.threads = options.threads;
  search.progress = options.progress;
  return search;
}

/// Exact data deserve the chain that reproduces them, where it is about as short as the one the
/// tolerance asks for.
bool try_exact(ChainSearchResult& best, const std::vector<FitPoint>& points, const Run& run,
               const RunOptions& options) {
  const double noise = options.noise / run.length;
  const double exact = std::max(kExactness, 6 * noise);
  if (options.pieces > 0 || exact * 20 > options.tolerance / run.length) return false;
  if (!best.within_tolerance || points.size() < 30) return false;
  ChainSearchOptions search = search_options(run, options);
  search.accept = {exact, 0};
  search.most_pieces = std::min<int>(96, static_cast<int>(points.size() / 4));
  search.start_pieces = std::min(48, search.most_pieces);
  ChainSearchResult found = search_chain(points, run.closed, search);
  if (!found.within_tolerance) return false;
  if (found.chain.pieces.size() > 2 * best.chain.pieces.size() + 3) return false;
  best = std::move(found);
  return true;
}

/// Jets of the spline at the run's two ends, for clamps, in the canonical frame.
void clamp_ends(ChainSearchResult&, FitChain& chain, const Run& run, const RunFrame& frame,
                const curve::BSpline2& spline) {
  const auto hold = [](Clamp clamp) { return static_cast<Hold>(static_cast<int>(clamp)); };
  chain.hold_start = hold(frame.reversed ? run.clamp_end : run.clamp_start);
  chain.hold_end = hold(frame.reversed ? run.clamp_start : run.clamp_end);
  const auto set = [&](FitJoint& joint, Hold held, bool canonical_start) {
    if (held == Hold::free) return;
    const bool at_start = canonical_start != frame.reversed;
    const curve::Jet2 end = jet(spline, at_start ? 0.0 : 1.0);
    joint.position = core::apply(frame.to_canonical, end.point);
    if (held == Hold::position) return;
    const double turned =
        tangent_angle(end) + frame.to_canonical.rotation + (frame.reversed ? core::kPi : 0);
    joint.direction += core::wrap_angle(turned - joint.direction);
    if (held == Hold::direction) return;
    joint.curvature = (frame.reversed ? -1 : 1) * curvature(end) / frame.to_canonical.scale;
  };
  set(chain.joints.front(), chain.hold_start, true);
  set(chain.joints.back(), chain.hold_end, false);
}

}  // namespace

RunResult fair_run(const Run& run, const curve::BSpline2& spline, const RunOptions& options) {
  const RunFrame frame = make_frame(run);
  std::vector<FitPoint> points = condense(frame.points, frame.weights, kMostFitPoints);
  ChainSearchResult search = search_chain(points, run.closed, search_options(run, options));
  RunResult result;
  result.exact = try_exact(search, points, run, options);
  for (std::size_t j = 0; j < points.size(); ++j) points[j].weight = search.weights[j];
  result.fit = std::move(search.chain);
  result.points = std::move(points);
  result.to_canonical = frame.to_canonical;
  result.reversed = frame.reversed;
  result.cancelled = search.cancelled;
  result.start_pieces = search.start_pieces;
  Acceptance accept{options.tolerance / run.length, options.noise / run.length};
  if (result.exact) accept = {std::max(kExactness, 6 * accept.noise), 0};
  if (!run.closed) clamp_ends(search, result.fit, run, frame, spline);
  if (search.within_tolerance && options.pieces == 0)
    result.straightened = straighten(result.fit, result.points, accept);
  result.within_tolerance = polish(result.fit, result.points, accept);
  result.chain = lay_out(result.fit, result.to_canonical, result.reversed);
  return result;
}

}  // namespace keyline::fairing::detail
