#include "keyline/fairing/local_pose.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "keyline/core/angle.h"

namespace keyline::fairing::detail {

core::Point2 Track::point(long i) const {
  const long n = static_cast<long>(points.size());
  return points[((i % n) + n) % n].position;
}

double Track::at(long i) const {
  const long n = static_cast<long>(points.size());
  const long turns = (i >= 0 ? i : i - n + 1) / n;
  return position[i - turns * n] + static_cast<double>(turns) * total;
}

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

}  // namespace keyline::fairing::detail
