#include "keyline/fairing/run_frame.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "keyline/core/angle.h"
#include "keyline/core/polygon.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kHeavy = 1e6;  // weight of a point that must be passed

/// True where the run is taken from its end.
bool runs_backwards(const Run& run, core::Point2 centroid) {
  const std::size_t n = run.points.size();
  if (run.closed) {
    double area = 0;
    for (std::size_t i = 0; i < n; ++i)
      area += core::cross(run.points[i] - centroid, run.points[(i + 1) % n] - centroid);
    return area < 0;
  }
  double balance = 0;
  for (std::size_t i = 0; i < n / 2; ++i)
    balance +=
        core::distance(run.points[n - 1 - i], centroid) - core::distance(run.points[i], centroid);
  return balance < 0;
}

std::size_t farthest(const std::vector<core::Point2>& points, core::Point2 centroid) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (core::distance(points[i], centroid) > core::distance(points[best], centroid) * (1 + 1e-12))
      best = i;
  return best;
}

/// Turns the way to the centroid onto the x axis; a half's line of symmetry instead, the way as
/// nearly as that allows.
double turn_of(const Run& run, core::Vector2 to_centroid) {
  if (!run.axis) return -core::direction_of(to_centroid);
  const bool against = core::dot(core::unit_vector(run.axis->direction), to_centroid) < 0;
  return -run.axis->direction + (against ? core::kPi : 0);
}

}  // namespace

RunFrame make_frame(const Run& run) {
  RunFrame frame;
  const std::size_t n = run.points.size();
  const core::Point2 centroid = core::centroid(run.points);
  frame.reversed = runs_backwards(run, centroid);
  frame.order.resize(n);
  std::iota(frame.order.begin(), frame.order.end(), std::size_t{0});
  if (frame.reversed) std::reverse(frame.order.begin(), frame.order.end());
  if (run.closed) {
    const auto start =
        std::find(frame.order.begin(), frame.order.end(), farthest(run.points, centroid));
    std::rotate(frame.order.begin(), start, frame.order.end());
  }
  const core::Point2 first = run.points[frame.order.front()];
  const double turn = turn_of(run, centroid - first);
  const double scale = 1 / run.length;
  const core::Vector2 moved = core::rotate_ccw({first.x, first.y}, turn);
  frame.to_canonical = {scale, turn, -scale * moved};
  frame.weights.assign(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const core::Vector2 v = scale * core::rotate_ccw(run.points[frame.order[i]] - first, turn);
    frame.points.push_back({v.x, v.y});
    if (!run.weights.empty()) frame.weights[i] = run.weights[frame.order[i]];
  }
  for (const std::size_t index : run.must_pass) {
    const auto at = std::find(frame.order.begin(), frame.order.end(), index);
    frame.weights[at - frame.order.begin()] *= kHeavy;
  }
  return frame;
}

}  // namespace keyline::fairing::detail
