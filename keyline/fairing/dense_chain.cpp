#include <algorithm>
#include <cmath>
#include <numbers>

#include "keyline/core/angle.h"
#include "keyline/fairing/chain_search.h"
#include "keyline/fairing/local_pose.h"
#include "keyline/lac/g2/spline.h"

namespace keyline::fairing {

using detail::local_pose;
using detail::make_track;
using detail::Track;

FitChain dense_chain(const std::vector<FitPoint>& points, bool closed, int pieces) {
  const Track track = make_track(points, closed);
  FitChain chain;
  chain.closed = closed;
  chain.first_at_start = chain.last_at_end = !closed;
  const double length = track.total / pieces;
  for (int i = 0; i <= pieces; ++i) {
    FitJoint joint = local_pose(track, length * i, 0.7 * length);
    if (i > 0) {
      const double before = chain.joints.back().direction;
      joint.direction = before + core::wrap_angle(joint.direction - before);
    }
    chain.joints.push_back(joint);
  }
  if (closed) {
    const double turn = chain.joints.back().direction - chain.joints.front().direction;
    chain.turning = 2 * core::kPi * std::round(turn / (2 * core::kPi));
    chain.joints.back() = chain.joints.front();
    chain.joints.back().direction += chain.turning;
  }
  chain.pieces.assign(pieces, {length, -1, PieceKind::curve, false});
  for (const double s : track.position) {
    const double at = std::min(s / length, pieces - 1e-9);
    const int piece = static_cast<int>(at);
    chain.feet.push_back({piece, at - piece});
  }
  if (!closed) chain.feet.back() = {pieces - 1, 1.0};
  return chain;
}

FitChain spline_chain(const std::vector<FitPoint>& points, bool closed) {
  std::vector<core::Point2> through;
  FitChain chain;
  for (const FitPoint& p : points) {
    const int at = static_cast<int>(through.size());
    const bool guide = p.count == 0;  // stands between two measured points
    chain.feet.push_back(guide ? Foot{at - 1, 0.5} : Foot{at, 0});
    if (!guide) through.push_back(p.position);
  }
  lac::SplineOptions clothoids;
  clothoids.closed = closed;
  const auto spline = lac::solve_spline(through, clothoids);
  const std::size_t spans = closed ? through.size() : through.size() - 1;
  if (!spline || spline->chain.pieces.size() != spans) return {};
  chain.closed = closed;
  chain.first_at_start = chain.last_at_end = !closed;
  double direction = spline->chain.start.direction;
  for (const lac::Segment& s : lac::segments(spline->chain)) {
    chain.joints.push_back({s.start.position, direction, s.curvature_start});
    chain.pieces.push_back({.length = s.length, .alpha = -1});
    direction += lac::total_turning(s);
  }
  chain.joints.push_back({closed ? through.front() : through.back(), direction,
                          spline->chain.pieces.back().curvature_end});
  chain.turning = closed ? direction - chain.joints.front().direction : 0;
  if (closed) chain.turning = 2 * core::kPi * std::round(chain.turning / (2 * core::kPi));
  if (!closed) chain.feet.back() = {static_cast<int>(spans) - 1, 1.0};
  return chain;
}

}  // namespace keyline::fairing
