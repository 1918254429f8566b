#pragma once

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/fairing/rate_model.h"
#include "keyline/lac/chain/chain.h"

/// Chains laid out for tests of the linear model of rates, and its rows beside differences.
namespace keyline::fairing::detail {

/// A chain, points on it, and a problem about them.
struct Given {
  FitChain chain;
  std::vector<FitPoint> points;
  RateProblem problem;
};

/// Six points beside every piece of a chain laid out from these, to the left of it by off(i, k) but
/// at the ends of an open one.
template <class Off>
Given of_pieces(const std::vector<lac::Piece>& pieces, bool closed, const Off& off) {
  Given g;
  const lac::Chain truth{{{0, 0}, 0.2}, pieces, false};
  const auto segments = lac::segments(truth);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const lac::Segment& s = segments[i];
    g.chain.joints.push_back({s.start.position, s.start.direction, s.curvature_start});
    g.chain.pieces.push_back({.length = s.length, .alpha = s.alpha});
    if (s.curvature_start == 0 && s.curvature_end == 0)
      g.chain.pieces.back().kind = PieceKind::line;
    for (int k = 0; k < 6; ++k) {
      const bool first = i == 0 && k == 0, last = i + 1 == segments.size() && k == 5;
      const bool tip = !closed && (first || last);
      const double t = !tip ? (k + 0.5) / 6 : first ? 0 : 1;
      const core::Pose2 pose = lac::pose_at(s, t);
      const core::Vector2 left = core::perpendicular_left(core::unit_vector(pose.direction));
      g.points.push_back({.position = pose.position + (tip ? 0 : off(int(i), k)) * left});
      g.chain.feet.push_back({static_cast<int>(i), t});
    }
    g.problem.growth.push_back(std::abs(s.curvature_end) > std::abs(s.curvature_start) ? 1 : -1);
  }
  const core::Pose2 end = lac::end_pose(truth);
  g.chain.joints.push_back({end.position, end.direction, pieces.back().curvature_end});
  g.chain.closed = closed;
  g.chain.first_at_start = g.chain.last_at_end = !closed;
  g.problem.joints = rate_joints(g.chain);
  g.problem.slopes.assign(pieces.size(), {-3, 3});
  g.problem.weights = {
      .tolerance = 0.01, .energy = 20, .band = 3, .power = 4, .jump = 0.5, .even = 0.1};
  g.problem.end = g.chain.joints.back();
  return g;
}

inline Given of_pieces(const std::vector<lac::Piece>& pieces, bool closed = false) {
  return of_pieces(pieces, closed, [](int, int) { return 0.0; });
}

/// A model a small step of one of its unknowns up and down: what either tells for differences.
struct Beside {
  static constexpr double kStep = 1e-5;
  RateModel up, down;

  Beside(const RateModel& model, const Given& g, int unknown)
      : up(model.moved(step(model, unknown), 1), g.problem),
        down(model.moved(step(model, unknown), -1), g.problem) {
    up.linearise();
    down.linearise();
  }
  static double difference(double above, double below) { return (above - below) / (2 * kStep); }

 private:
  static Eigen::VectorXd step(const RateModel& model, int unknown) {
    return kStep * Eigen::VectorXd::Unit(model.unknowns.count(), unknown);
  }
};

/// All rows but those of the jumps, and the equations, against differences.
inline void expect_differences(const RateModel& model, const Given& g) {
  const auto pieces = static_cast<Eigen::Index>(g.chain.pieces.size());
  const auto jumps = static_cast<Eigen::Index>(g.points.size()) + pieces;
  const auto behind = jumps + static_cast<Eigen::Index>(g.problem.joints.size());
  for (int k = 0; k < model.unknowns.count(); ++k) {
    const Beside beside(model, g, k);
    for (Eigen::Index r = 0; r < model.value.size(); ++r) {
      if (r >= jumps && r < behind) continue;
      EXPECT_NEAR(model.rows(r, k), Beside::difference(beside.up.value(r), beside.down.value(r)),
                  1e-3 * (1 + std::abs(model.rows(r, k))))
          << r << ' ' << k;
    }
    for (Eigen::Index r = 0; r < model.miss.size(); ++r)
      EXPECT_NEAR(model.equation(r, k), Beside::difference(beside.up.miss(r), beside.down.miss(r)),
                  1e-4)
          << r << ' ' << k;
  }
}

}  // namespace keyline::fairing::detail
