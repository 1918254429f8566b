#include "keyline/fairing/meet.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "keyline/core/angle.h"
#include "keyline/lac/segment/sensitivity.h"
#include "keyline/numeric/solve.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kRounds = 30;  // Newton steps at most: it stops where one brings the end no nearer

bool is_arc(const lac::Piece& piece) { return piece.curvature_start == piece.curvature_end; }

/// Which unknown each joint's curvature is, counted: arcs and the seam make several joints one.
/// -1: kept as it is.
std::vector<int> curvature_unknowns(const lac::Chain& chain, const Target& target, int& count) {
  const std::size_t n = chain.pieces.size();
  std::vector<int> unknown(n + 1);
  unknown[0] = chain.closed || target.start_curvature_free ? count++ : -1;
  for (std::size_t i = 0; i < n; ++i)
    unknown[i + 1] = is_arc(chain.pieces[i]) ? unknown[i] : count++;
  // The last joint is the first of a closed chain; arcs carry that, or its hold, backwards.
  const int last = unknown[n];
  if (!chain.closed && target.end_curvature_free) return unknown;
  if (!chain.closed) {
    for (int& u : unknown)
      if (u == last) u = -1;
    return unknown;
  }
  for (int& u : unknown)
    if (u == last) u = unknown[0];
  return unknown;
}

Eigen::Vector3d miss_of(const lac::Chain& chain, const Target& target) {
  const core::Pose2 end = lac::end_pose(chain);
  const double turn = core::wrap_angle(end.direction - target.pose.direction);
  return {end.position.x - target.pose.position.x, end.position.y - target.pose.position.y,
          target.direction ? turn : 0};
}

/// Change of the chain's end pose by shares of the curvatures and lengths and by the start
/// direction (last column).
Eigen::Matrix3Xd end_by_unknowns(const lac::Chain& chain, const std::vector<int>& unknown,
                                 int curvatures) {
  const int n = static_cast<int>(chain.pieces.size());
  const auto segments = lac::segments(chain);
  const core::Point2 end = lac::end_pose(chain).position;
  Eigen::Matrix3Xd by = Eigen::Matrix3Xd::Zero(3, curvatures + n + 1);
  for (int i = 0; i < n; ++i) {
    const lac::Piece& piece = chain.pieces[i];
    lac::PieceTable table;
    table.build(piece.curvature_start, piece.curvature_end, piece.length, piece.alpha, true);
    const auto& local = table.end();
    const double c = std::cos(segments[i].start.direction);
    const double s = std::sin(segments[i].start.direction);
    const core::Vector2 arm = end - lac::end_pose(segments[i]).position;
    const auto add = [&](int column, int q, double size) {
      if (column < 0) return;
      const double turn = local.dangle[q];
      by(0, column) += size * (c * local.dx[q] - s * local.dy[q] - arm.y * turn);
      by(1, column) += size * (s * local.dx[q] + c * local.dy[q] + arm.x * turn);
      by(2, column) += size * turn;
    };
    add(unknown[i], lac::kCurvatureStart, piece.curvature_start);
    add(unknown[i + 1], lac::kCurvatureEnd, piece.curvature_end);
    add(curvatures + i, lac::kLength, piece.length);
  }
  const core::Vector2 whole = end - chain.start.position;
  by.col(curvatures + n) << -whole.y, whole.x, 1;
  return by;
}

}  // namespace

double meet_target(lac::Chain& chain, const Target& target) {
  int curvatures = 0;
  const std::vector<int> unknown = curvature_unknowns(chain, target, curvatures);
  const double length = lac::arc_length(chain);
  const auto size = [&](const Eigen::Vector3d& m) {
    return m.head<2>().norm() + length * std::abs(m(2));
  };
  Eigen::Vector3d miss = miss_of(chain, target);
  for (int round = 0; round < kRounds && size(miss) > 0; ++round) {
    Eigen::Matrix3Xd by = end_by_unknowns(chain, unknown, curvatures);
    if (!target.direction) by.row(2).setZero();
    if (!target.start_direction_free) by.rightCols<1>().setZero();
    const Eigen::VectorXd change = numeric::least_norm(by, -miss).cwiseMax(-0.3).cwiseMin(0.3);
    lac::Chain next = chain;
    next.start.direction += change(change.size() - 1);
    for (std::size_t i = 0; i < next.pieces.size(); ++i) {
      lac::Piece& piece = next.pieces[i];
      const auto share = [&](int u) { return u < 0 ? 1.0 : 1 + change(u); };
      piece.curvature_start *= share(unknown[i]);
      piece.curvature_end *= share(unknown[i + 1]);
      piece.length *= 1 + change(curvatures + static_cast<int>(i));
    }
    const Eigen::Vector3d after = miss_of(next, target);
    if (!(size(after) < size(miss))) break;
    chain = std::move(next);
    miss = after;
  }
  return size(miss);
}

}  // namespace keyline::fairing::detail
