#include "keyline/fairing/run_again.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"
#include "keyline/fairing/bound.h"
#include "keyline/fairing/calm_run.h"
#include "keyline/fairing/settle.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kMoreMargin = 1.2;  // of what the chain passes the border by

}  // namespace

namespace {

/// An end that stands on the line of symmetry, square to it where the curve runs across smoothly.
HeldEnd end_on_axis(const Run& run, const RunFrame& frame, bool canonical_start, HalfEnd how) {
  const double y = core::apply(frame.to_canonical, run.axis->position).y;
  const std::vector<core::Point2>& points = frame.points;
  const core::Point2 last = canonical_start ? points.front() : points.back();
  const core::Point2 middle = points[points.size() / 2];
  HeldEnd held{how == HalfEnd::square ? Hold::direction : Hold::position, {}, true};
  const bool leaves_upwards = (middle.y > y) == canonical_start;
  held.joint = {{last.x, y}, (leaves_upwards ? 0.5 : -0.5) * core::kPi, 0};
  return held;
}

}  // namespace

HeldEnd held_end(const Run& run, const RunFrame& frame, const curve::BSpline2& spline,
                 bool canonical_start) {
  if (run.closed) return {};
  const bool at_start = canonical_start != frame.reversed;
  const Clamp clamp = at_start ? run.clamp_start : run.clamp_end;
  const auto& tie = at_start ? run.tie_start : run.tie_end;
  HeldEnd held{static_cast<Hold>(static_cast<int>(clamp)), {}};
  const HalfEnd on_axis = at_start ? run.start_on_axis : run.end_on_axis;
  if (on_axis != HalfEnd::free) return end_on_axis(run, frame, canonical_start, on_axis);
  if (tie) return {Hold::position, {core::apply(frame.to_canonical, *tie), 0, 0}};
  if (held.hold == Hold::free) return held;
  const curve::Jet2 end = jet(spline, at_start ? 0.0 : 1.0);
  held.joint.position = core::apply(frame.to_canonical, end.point);
  held.joint.direction =
      tangent_angle(end) + frame.to_canonical.rotation + (frame.reversed ? core::kPi : 0);
  held.joint.curvature = (frame.reversed ? -1 : 1) * curvature(end) / frame.to_canonical.scale;
  return held;
}

FitChain closed_chain(const DenseCurve& curve, const std::vector<FitPoint>& points,
                      double tolerance) {
  FitChain chain = chain_of(curve);
  ChainFitOptions fit;
  fit.fine = true;
  fit.scale = tolerance;
  fit.close_gaps = true;
  fit.iterations = 20;
  fit_chain(chain, points, fit);
  return chain;
}

double largest_offset(const RunResult& result, const Run& run) {
  if (result.chain.pieces.empty()) return HUGE_VAL;  // it winds, and was not laid out
  double most = 0;
  for (const PointPlace& place : place_points(result, run))
    most = std::max(most, std::abs(place.offset));
  return most;
}

bool solve_again(RunResult& result, const Run& run, const curve::BSpline2& spline, double share) {
  const RunFrame frame = make_frame(run);
  const double tolerance = share * kBandShare * result.accept.tolerance;
  const bool within =
      hold_ends(result.dense, result.points, tolerance, result.spring,
                held_end(run, frame, spline, true), held_end(run, frame, spline, false))
          .within;
  result.fit = closed_chain(result.dense, result.points, tolerance);
  result.chain = lay_out(result.fit, result.to_canonical, result.reversed);
  return within;
}

namespace {

std::vector<core::HalfPlane> canonical(const RunResult& result, const Run& run) {
  std::vector<core::HalfPlane> inside;
  for (const core::HalfPlane& half : run.inside)
    inside.push_back(core::apply(result.to_canonical, half));
  return inside;
}

/// The fitted points' limits, with the run's margin.
void limit_to(RunResult& result, const Run& run) {
  std::vector<double> margin(run.inside.size(), 0);
  for (std::size_t i = 0; i < run.margin.size(); ++i)
    margin[i] = run.margin[i] * result.to_canonical.scale;
  std::vector<core::Point2> held;
  for (const auto& tie : {run.tie_start, run.tie_end})
    if (tie) held.push_back(core::apply(result.to_canonical, *tie));
  limit_offsets(result.points, run.closed, canonical(result, run), margin, held);
}

/// By how much the chain passes each border.
std::vector<double> passed(const lac::Chain& chain, const Run& run) {
  std::vector<double> by;
  for (const core::HalfPlane& half : run.inside) by.push_back(outside(chain, half));
  return by;
}

}  // namespace

void watch_borders(RunResult& result, const Run& run, double tolerance) {
  if (run.inside.empty()) return;
  const std::vector<core::HalfPlane> inside = canonical(result, run);
  if (!run.closed) draw_ends_inside(result.points, inside, tolerance);
  result.points = with_watchers(result.points, run.closed, inside, tolerance);
  limit_to(result, run);
}

bool stays_inside(const RunResult& result, const Run& run) {
  if (run.inside.empty()) return true;
  const lac::Chain chain = lay_out(result.fit, result.to_canonical, result.reversed);
  return std::ranges::max(passed(chain, run)) <= 0;
}

double passed_most(const RunResult& result, const Run& run) {
  return run.inside.empty() ? 0 : std::ranges::max(passed(result.chain, run));
}

void add_margin(Run& run, const RunResult& result) {
  const std::vector<double> by = passed(result.chain, run);
  run.margin.resize(by.size());
  for (std::size_t i = 0; i < by.size(); ++i) run.margin[i] += kMoreMargin * by[i];
}

bool solve_inside(RunResult& result, const Run& run, const curve::BSpline2& spline) {
  limit_to(result, run);
  return solve_again(result, run, spline, 1);
}

}  // namespace keyline::fairing::detail
