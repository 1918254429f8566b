#include "keyline/fairing/run.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"
#include "keyline/fairing/condense.h"
#include "keyline/fairing/guides.h"
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
void clamp_ends(FitChain& chain, const Run& run, const RunFrame& frame,
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

/// The search, once more with a tighter tolerance where polishing loses what it had found.
void solve(RunResult& result, const Run& run, const RunFrame& frame, const curve::BSpline2& spline,
           const RunOptions& options) {
  const std::vector<FitPoint> measured = result.points;
  for (const double share : {1.0, 0.93, 0.8}) {
    RunOptions tighter = options;
    tighter.tolerance *= share;
    result.points = with_guides(measured, run.closed, tighter.tolerance / run.length);
    ChainSearchResult search =
        search_chain(result.points, run.closed, search_options(run, tighter));
    const bool found = search.within_tolerance;
    if (share == 1) result.exact = try_exact(search, measured, run, options);
    if (result.exact) result.points = measured;
    for (std::size_t j = 0; j < result.points.size(); ++j)
      result.points[j].weight = search.weights[j];
    result.fit = std::move(search.chain);
    result.cancelled = search.cancelled;
    result.start_pieces = search.start_pieces;
    if (result.exact) result.accept = {std::max(kExactness, 6 * result.accept.noise), 0};
    if (!run.closed) clamp_ends(result.fit, run, frame, spline);
    if (found && options.pieces == 0)
      result.straightened = straighten(result.fit, result.points, result.accept);
    result.within_tolerance = polish(result.fit, result.points, result.accept);
    if (result.within_tolerance || !found || options.pieces > 0 || search.cancelled) break;
  }
}

}  // namespace

RunResult fair_run(const Run& run, const curve::BSpline2& spline, const RunOptions& options) {
  const RunFrame frame = make_frame(run);
  RunResult result;
  result.points = condense(frame.points, frame.weights, kMostFitPoints);
  result.to_canonical = frame.to_canonical;
  result.reversed = frame.reversed;
  result.accept = {options.tolerance / run.length, options.noise / run.length};
  solve(result, run, frame, spline, options);
  std::vector<std::size_t> measured;
  for (std::size_t j = 0; j < result.points.size(); ++j)
    if (result.points[j].count > 0) measured.push_back(j);
  result.point_of.resize(run.points.size());
  for (std::size_t j = 0; j < frame.order.size(); ++j)
    result.point_of[frame.order[j]] =
        measured[condensed_index(j, frame.order.size(), kMostFitPoints)];
  result.chain = lay_out(result.fit, result.to_canonical, result.reversed);
  return result;
}

void tie_ends(RunResult& result, const std::optional<core::Point2>& start,
              const std::optional<core::Point2>& end) {
  const auto tie = [&](FitJoint& joint, Hold& hold, const std::optional<core::Point2>& at) {
    if (!at) return;
    joint.position = core::apply(result.to_canonical, *at);
    hold = std::max(hold, Hold::position);
  };
  FitChain& chain = result.fit;
  tie(chain.joints.front(), chain.hold_start, result.reversed ? end : start);
  tie(chain.joints.back(), chain.hold_end, result.reversed ? start : end);
  result.within_tolerance = polish(chain, result.points, result.accept);
  result.chain = lay_out(chain, result.to_canonical, result.reversed);
}

}  // namespace keyline::fairing::detail
