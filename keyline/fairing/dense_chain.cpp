#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "keyline/core/angle.h"
#include "keyline/fairing/chain_search.h"
#include "keyline/lac/spline.h"

namespace keyline::fairing {
namespace {

/// Points with their chord-length position; closed curves can be read past either end.
struct Track {
  const std::vector<FitPoint>& points;
  std::vector<double> position;
  double total = 0;
  bool closed = false;

  core::Point2 point(long i) const {
    const long n = static_cast<long>(points.size());
    return points[((i % n) + n) % n].position;
  }
  double at(long i) const {
    const long n = static_cast<long>(points.size());
    const long turns = (i >= 0 ? i : i - n + 1) / n;
    return position[i - turns * n] + static_cast<double>(turns) * total;
  }
};

Track make_track(const std::vector<FitPoint>& points, bool closed) {
  Track track{points, {}, 0, closed};
  track.position.resize(points.size());
  for (std::size_t i = 1; i < points.size(); ++i)
    track.position[i] =
        track.position[i - 1] + core::distance(points[i - 1].position, points[i].position);
  track.total = track.position.back();
  if (closed) track.total += core::distance(points.back().position, points.front().position);
  return track;
}

/// Parabola in arc position through the points near s, at least five of them.
FitJoint local_pose(const Track& track, double s, double reach) {
  const long n = static_cast<long>(track.points.size());
  long lo =
      std::lower_bound(track.position.begin(), track.position.end(), s) - track.position.begin();
  long hi = lo;
  const long first = track.closed ? -n : 0;
  const long last = track.closed ? 2 * n - 1 : n - 1;
  lo = std::min(lo, n - 1);
  hi = lo;
  while (hi - lo < 4 || s - track.at(lo) < reach || track.at(hi) - s < reach) {
    const bool can_lo = lo > first && (s - track.at(lo) < reach || hi - lo < 4);
    const bool can_hi = hi < last && (track.at(hi) - s < reach || hi - lo < 4);
    if (!can_lo && !can_hi) break;
    if (can_lo) --lo;
    if (can_hi) ++hi;
    if (hi - lo > n) break;
  }
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> rhs = Eigen::Matrix<double, 3, 2>::Zero();
  const double scale = std::max({reach, s - track.at(lo), track.at(hi) - s, 1e-12});
  for (long i = lo; i <= hi; ++i) {
    const double u = (track.at(i) - s) / scale;
    const Eigen::Vector3d row(1, u, u * u);
    const double w = 1.02 - std::min(1.0, u * u);
    normal += w * row * row.transpose();
    const core::Point2 p = track.point(i);
    rhs.col(0) += w * p.x * row;
    rhs.col(1) += w * p.y * row;
  }
  normal.diagonal().array() += 1e-12 * normal(0, 0);
  const Eigen::Matrix<double, 3, 2> c = normal.ldlt().solve(rhs);
  const core::Vector2 d{c(1, 0) / scale, c(1, 1) / scale};
  const core::Vector2 dd{2 * c(2, 0) / (scale * scale), 2 * c(2, 1) / (scale * scale)};
  const double speed = std::max(core::norm(d), 1e-9);
  return {{c(0, 0), c(0, 1)}, core::direction_of(d), core::cross(d, dd) / (speed * speed * speed)};
}

}  // namespace

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
