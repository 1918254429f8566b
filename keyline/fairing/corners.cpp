#include "keyline/fairing/corners.h"

#include <algorithm>

#include "keyline/fairing/run_again.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kCornerRoom =
    0.9;  // of the tolerance: how far chains may meet from a corner's point

/// The place, or the nearest to it that leaves the corner's own point inside the tolerance.
core::Point2 near_corner(core::Point2 place, core::Point2 corner, double tolerance) {
  const double most = kCornerRoom * tolerance;
  const double far = core::distance(place, corner);
  return far <= most ? place : corner + (most / far) * (place - corner);
}

/// Where the chain of one run and that of the next meet.
core::Point2 meeting(const Run& run, const RunResult& one, const RunResult& next,
                     double tolerance) {
  const core::Point2 from = lac::end_pose(one.chain).position;
  const core::Point2 to = next.chain.start.position;
  core::Point2 place = near_corner(from + 0.5 * (to - from), run.points.back(), tolerance);
  for (const core::HalfPlane& half : run.inside)
    place = place - std::min(0.0, core::depth(half, place)) * half.normal;
  return place;
}

}  // namespace

void tie_corners(std::vector<Run>& runs, std::vector<RunResult>& solved,
                 const std::vector<curve::BSpline2>& splines, const OptionsOf& options,
                 bool round) {
  const std::size_t n = runs.size();
  if (runs.front().closed) return;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    if (next == 0 && !round) break;
    if (runs[k].clamp_end != Clamp::none || runs[next].clamp_start != Clamp::none) continue;
    runs[k].tie_end = runs[next].tie_start =
        meeting(runs[k], solved[k], solved[next], options(k).tolerance);
  }
  for (std::size_t k = 0; k < n; ++k)
    if (runs[k].tie_start || runs[k].tie_end)
      tie_ends(solved[k], runs[k], k < splines.size() ? splines[k] : curve::BSpline2{}, options(k));
}

}  // namespace keyline::fairing::detail
