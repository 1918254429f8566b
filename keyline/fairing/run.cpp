#include "keyline/fairing/run.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"
#include "keyline/fairing/condense.h"
#include "keyline/fairing/exact_chain.h"
#include "keyline/fairing/guides.h"
#include "keyline/fairing/run_frame.h"
#include "keyline/fairing/settle.h"

namespace keyline::fairing::detail {
namespace {

constexpr std::size_t kMostFitPoints = 1200;

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

/// What is held at the canonical start or end of a run: its clamp, by the spline, or its tie.
HeldEnd held_end(const Run& run, const RunFrame& frame, const curve::BSpline2& spline,
                 bool canonical_start) {
  if (run.closed) return {};
  const bool at_start = canonical_start != frame.reversed;
  const Clamp clamp = at_start ? run.clamp_start : run.clamp_end;
  const auto& tie = at_start ? run.tie_start : run.tie_end;
  HeldEnd held{static_cast<Hold>(static_cast<int>(clamp)), {}};
  if (tie) return {Hold::position, {core::apply(frame.to_canonical, *tie), 0, 0}};
  if (held.hold == Hold::free) return held;
  const curve::Jet2 end = jet(spline, at_start ? 0.0 : 1.0);
  held.joint.position = core::apply(frame.to_canonical, end.point);
  held.joint.direction =
      tangent_angle(end) + frame.to_canonical.rotation + (frame.reversed ? core::kPi : 0);
  held.joint.curvature = (frame.reversed ? -1 : 1) * curvature(end) / frame.to_canonical.scale;
  return held;
}

/// The search, once more with a tighter tolerance where polishing loses what it had found.
void solve(RunResult& result, const Run& run, const RunFrame& frame, const curve::BSpline2& spline,
           const RunOptions& options) {
  const std::vector<FitPoint> measured = result.points;
  for (const double share : {0.98, 0.9, 0.8}) {
    RunOptions tighter = options;
    tighter.tolerance *= share;
    result.points =
        with_guides(cut_digits(measured), run.closed, rounded(tighter.tolerance / run.length));
    ChainSearchOptions searching = search_options(run, tighter);
    searching.start = held_end(run, frame, spline, true);
    searching.end = held_end(run, frame, spline, false);
    ChainSearchResult search = search_chain(result.points, run.closed, searching);
    const bool found = search.within_tolerance;
    if (share > 0.95) result.exact = find_exact(search, measured, run.closed, searching);
    if (result.exact) result.points = measured;
    for (std::size_t j = 0; j < result.points.size(); ++j)
      result.points[j].weight = search.weights[j];
    result.fit = std::move(search.chain);
    result.start_pieces = search.start_pieces;
    if (result.exact) result.accept = {exactness(result.accept), 0};
    if (found && options.pieces == 0)
      result.straightened = straighten(result.fit, result.points, result.accept);
    result.within_tolerance = polish(result.fit, result.points, result.accept, result.exact);
    if (result.within_tolerance || !found || options.pieces > 0 || search.cancelled) break;
  }
}

}  // namespace

RunResult fair_run(const Run& run, const curve::BSpline2& spline, const RunOptions& options) {
  const RunFrame frame = make_frame(run);
  RunResult result;
  result.points = condense(frame.points, frame.weights, kMostFitPoints);
  for (std::size_t j = 0; j < frame.order.size(); ++j)
    if (std::find(run.must_pass.begin(), run.must_pass.end(), frame.order[j]) !=
        run.must_pass.end())
      result.points[condensed_index(j, frame.order.size(), kMostFitPoints)].must_pass = true;
  result.to_canonical = frame.to_canonical;
  result.reversed = frame.reversed;
  result.accept = search_options(run, options).accept;
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

void tie_ends(RunResult& result, const Run& run, const curve::BSpline2& spline,
              const RunOptions& options) {
  const RunFrame frame = make_frame(run);
  const RunResult loose = result;
  const auto tie = [](FitJoint& joint, Hold& hold, const HeldEnd& end) {
    if (end.hold == Hold::free) return;
    joint.position = end.joint.position;
    hold = std::max(hold, end.hold);
  };
  FitChain& chain = result.fit;
  tie(chain.joints.front(), chain.hold_start, held_end(run, frame, spline, true));
  tie(chain.joints.back(), chain.hold_end, held_end(run, frame, spline, false));
  result.within_tolerance = polish(chain, result.points, result.accept, result.exact);
  if (!result.within_tolerance && loose.within_tolerance)
    result = fair_run(run, spline, options);
  else
    result.chain = lay_out(chain, result.to_canonical, result.reversed);
}

}  // namespace keyline::fairing::detail
