#include "keyline/fairing/run_points.h"

#include <algorithm>
#include <cmath>

#include "keyline/fairing/condense.h"

namespace keyline::fairing::detail {
namespace {

constexpr std::size_t kFewCalmPoints = 400;  // means of more points tell the calmest curve as much
constexpr double kBesideAxis = 0.1;  // of the points' spacing: as good as on the line of symmetry
constexpr double kAxisRoom = 0.5;    // of the way to it: how far the curve may pass from its guide

/// Where each of the run's members belongs among the fitted points.
std::vector<std::size_t> fitted_of(const RunResult& result, const Run& run, const RunFrame& frame) {
  std::vector<std::size_t> held(run.points.size());
  const std::vector<std::size_t> by_order = holders(result, frame);
  for (std::size_t j = 0; j < frame.order.size(); ++j) held[frame.order[j]] = by_order[j];
  std::vector<std::size_t> fitted;
  for (const std::size_t k : run.members.fitted) fitted.push_back(held[k]);
  return fitted;
}

/// How many measured points each fitted one is the mean of, and how far they lie beside it.
void spread_members(RunResult& result, const Run& run, const RunFrame& frame) {
  std::vector<FitPoint>& points = result.points;
  const std::vector<std::size_t> fitted = fitted_of(result, run, frame);
  for (FitPoint& p : points) p.count = p.low = p.high = 0;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const std::size_t f = fitted[i];
    const core::Vector2 chord =
        points[std::min(f + 1, points.size() - 1)].position - points[f > 0 ? f - 1 : 0].position;
    const core::Vector2 normal =
        core::perpendicular_left(chord) / std::max(core::norm(chord), 1e-300);
    const double offset = core::dot(
        core::apply(result.to_canonical, run.members.points[i]) - points[f].position, normal);
    points[f].count += 1;
    points[f].low = std::min(points[f].low, offset);
    points[f].high = std::max(points[f].high, offset);
  }
}

}  // namespace

void take_points(RunResult& result, const Run& run, const RunFrame& frame, std::size_t most) {
  result.most_points = most;
  result.points = condense(frame.points, frame.weights, most);
  if (!run.members.points.empty()) spread_members(result, run, frame);
  for (std::size_t j = 0; j < frame.order.size(); ++j)
    if (std::ranges::count(run.must_pass, frame.order[j]) > 0)
      result.points[condensed_index(j, frame.order.size(), most)].must_pass = true;
}

void take_calm_points(RunResult& result, const Run& run, const RunFrame& frame, double tolerance) {
  std::size_t most = kFewCalmPoints;
  for (; most < kMostFitPoints; most *= 2) {
    take_points(result, run, frame, most);
    double bend = 0;
    for (std::size_t j = 1; j + 1 < result.points.size(); ++j) {
      const core::Point2 before = result.points[j - 1].position;
      const core::Vector2 chord = result.points[j + 1].position - before;
      const double across = core::cross(chord, result.points[j].position - before);
      if (result.points[j].count > 1)
        bend = std::max(bend, std::abs(across) / std::max(core::norm(chord), 1e-300));
    }
    if (bend <= tolerance) return;
  }
  take_points(result, run, frame, most);
}

std::vector<std::size_t> holders(const RunResult& result, const RunFrame& frame) {
  std::vector<std::size_t> measured;
  for (std::size_t j = 0; j < result.points.size(); ++j)
    if (result.points[j].count > 0) measured.push_back(j);
  std::vector<std::size_t> held;
  for (std::size_t j = 0; j < frame.order.size(); ++j)
    held.push_back(measured[condensed_index(j, frame.order.size(), result.most_points)]);
  return held;
}

Members members_of(const RunResult& result, const Run& run, const RunFrame& frame) {
  if (run.members.points.empty()) {
    if (run.points.size() <= result.most_points) return {};
    return {frame.points, holders(result, frame)};
  }
  Members members{{}, fitted_of(result, run, frame)};
  for (const core::Point2 p : run.members.points)
    members.points.push_back(core::apply(result.to_canonical, p));
  return members;
}

void reach_axis(std::vector<FitPoint>& points, const HeldEnd& start, const HeldEnd& end,
                double tolerance) {
  const auto guide = [&](const HeldEnd& held, const FitPoint& last, const FitPoint& next) {
    const double gap = core::distance(held.joint.position, last.position);
    std::vector<FitPoint> made;
    if (held.slides && gap > kBesideAxis * core::distance(last.position, next.position))
      made.push_back({.position = held.joint.position,
                      .count = 0,
                      .share = std::min(1.0, tolerance / (kAxisRoom * gap))});
    return made;
  };
  const std::size_t n = points.size();
  const std::vector<FitPoint> before = guide(start, points[0], points[1]);
  const std::vector<FitPoint> after = guide(end, points[n - 1], points[n - 2]);
  points.insert(points.begin(), before.begin(), before.end());
  points.insert(points.end(), after.begin(), after.end());
}

}  // namespace keyline::fairing::detail
