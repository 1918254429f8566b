#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/piece_energy.h"
#include "keyline/fairing/rate_descent.h"

#include "rate_given.h"

/// The linear model of rates on closed chains, beside lines, and what a point costs in it.
namespace keyline::fairing::detail {
namespace {

// Round a closed chain, whose first and last curvature are one unknown and whose seam is what its
// end misses of its start.
TEST(RateModel, RowsOfClosedChainsAreDifferences) {
  Given g = of_pieces({{-0.7, 0.4, 1, 3}, {0.4, 0.3, 3, 2}, {-1.5, 0.3, 2, 1}}, true);
  g.chain.turning = 1.5;
  ASSERT_EQ(g.problem.joints.size(), 1U);
  g.problem.joints[0].tied = true;
  for (std::size_t j = 0; j < g.points.size(); ++j)
    g.points[j].position.y += 0.002 * (static_cast<double>(j % 3) - 1);
  g.problem.points = &g.points;
  RateModel model(g.chain, g.problem);
  EXPECT_EQ(model.unknowns.joints, 3);
  EXPECT_EQ(model.unknowns.joint(3), model.unknowns.joint(0));
  model.linearise();
  expect_differences(model, g);
  ASSERT_EQ(model.miss.size(), 4);
  const FitJoint& last = g.chain.joints.back();
  EXPECT_NEAR(model.miss(0), last.position.x, 1e-6);  // it begins at the origin…
  EXPECT_NEAR(model.miss(1), last.position.y, 1e-6);
  EXPECT_NEAR(model.miss(2), last.direction - 0.2 - 1.5, 1e-6);  // …a turn of 1.5 back
}

// A line has neither slope nor variation, and its curvature stays.
TEST(RateModel, RowsBesideALineAreDifferences) {
  Given g = of_pieces({{-1, 0.3, 0, 0}, {-1, 0.3, 0, 2}, {0.5, 0.4, 2, 4}});
  g.problem.points = &g.points;
  RateModel model(g.chain, g.problem);
  model.linearise();
  expect_differences(model, g);
  EXPECT_EQ(model.limits.size(), 2U + 3);  // the line none; from 0 on no ratio
  EXPECT_EQ(model.rows.col(model.unknowns.slope(0)).norm(), 0);
  EXPECT_EQ(model.rows.col(model.unknowns.joint(0)).norm(), 0);
  EXPECT_NEAR(model.variation, (4 / 0.3 + std::pow(piece_energy(2, 4, 0.5).root, 2) / 0.4) / 20,
              1e-12);
  const FitChain moved = model.moved(Eigen::VectorXd::Constant(model.unknowns.count(), 0.1), 1);
  EXPECT_EQ(moved.pieces[0].alpha, -1);
  EXPECT_EQ(moved.joints[0].curvature, 0);
  EXPECT_NEAR(moved.pieces[0].length, 0.3 * std::exp(0.1), 1e-14);
  EXPECT_NEAR(moved.pieces[1].alpha, -0.9, 1e-14);
  EXPECT_NEAR(moved.joints[2].curvature, 2 * std::exp(0.1), 1e-14);
}

/// The middle point 0.005 left of the chain, as the test says what it may be.
double offset_of_middle(const FitPoint& like, double off) {
  Given g = of_pieces({{-1, 1, 0.5, 1}});
  g.problem.points = &g.points;
  const core::Pose2 at = lac::pose_at({{{0, 0}, 0.2}, -1, 1, 0.5, 1}, 3.5 / 6);
  g.points[3] = like;
  g.points[3].position =
      at.position + off * core::perpendicular_left(core::unit_vector(at.direction));
  return RateModel(g.chain, g.problem).offset[3];
}

// Offsets are shares of what the point may be off on its side: the tolerance, less its spread, or
// its own limit, a tenth of the tolerance at least.
TEST(RateModel, OffsetsAreSharesOfTheRoomOnTheirSide) {
  constexpr double off = 0.005;
  EXPECT_NEAR(offset_of_middle({}, off), 0.5, 1e-6);
  EXPECT_NEAR(offset_of_middle({}, -off), -0.5, 1e-6);
  EXPECT_NEAR(offset_of_middle({.position = {}, .low = -0.004, .high = 0.002}, off), 0.005 / 0.008,
              1e-6);
  EXPECT_NEAR(offset_of_middle({.position = {}, .low = -0.004, .high = 0.002}, -off),
              -0.005 / 0.006, 1e-6);
  EXPECT_NEAR(offset_of_middle({.position = {}, .low = -0.004, .high = 0.002, .share = 0.5}, off),
              0.0025 / 0.009, 1e-6);
  EXPECT_NEAR(offset_of_middle({.position = {}, .low = -0.004, .high = 0.002, .share = 0.5}, -off),
              -0.0025 / 0.008, 1e-6);
  EXPECT_NEAR(offset_of_middle({.position = {}, .lowest = -0.004, .highest = 0.002}, off), 2.5,
              1e-6);
  EXPECT_NEAR(offset_of_middle({.position = {}, .lowest = -0.004, .highest = 0.002}, -off), -1.25,
              1e-6);
  EXPECT_NEAR(offset_of_middle({.position = {}, .lowest = -1e-4, .highest = 1e-4}, off), 5, 1e-6);
}

// An offset counts from nine tenths of its room on by its power; beyond 1.3 of that as the tangent
// there goes on.
TEST(RateModel, WhatAPointCostsHasAKnee) {
  const auto cost = [](double off, double power) {
    Given g = of_pieces({{-1, 1, 0.5, 1}});
    g.problem.points = &g.points;
    const core::Pose2 at = lac::pose_at({{{0, 0}, 0.2}, -1, 1, 0.5, 1}, 3.5 / 6);
    g.points[3].position =
        at.position + off * core::perpendicular_left(core::unit_vector(at.direction));
    g.problem.weights.power = power;
    g.problem.price.assign(6, 1);
    const double once = RateModel(g.chain, g.problem).cost;
    g.problem.price[3] = 3;
    return RateModel(g.chain, g.problem).cost - once;
  };
  const double each = 2 * 3 / 6.0;  // two more of the band's weight, one of six points
  for (const double power : {2.0, 4.0})
    for (const double off : {0.004, -0.009, 0.0115})
      EXPECT_NEAR(cost(off, power), each * std::pow(std::abs(off) / 0.01 / 0.9, 2 * power), 1e-4)
          << off;
  const double a = 2 / 0.9, tangent = std::pow(1.3, 4) + 4 * std::pow(1.3, 3) * (a - 1.3);
  EXPECT_NEAR(cost(0.02, 4), each * tangent * tangent, 1e-2);
  EXPECT_NEAR(cost(-0.02, 4), each * tangent * tangent, 1e-2);
}

// Round an ellipse of length 1 in eight clothoids, which do not meet at first.
TEST(CloseRates, ClosedChainsMeet) {
  Given g;
  const auto at = [](double t) { return core::Point2{2 * std::cos(t), std::sin(t)}; };
  double length = 0;
  std::vector<double> up{0};
  constexpr int kFine = 8000;
  for (int i = 1; i <= kFine; ++i) {
    const double t = 2 * M_PI * i / kFine;
    length += core::distance(at(t), at(t - 2 * M_PI / kFine));
    if (i % (kFine / 8) == 0) up.push_back(length);
  }
  for (int i = 0; i <= 8; ++i) {
    const double t = M_PI / 4 * i;
    const double speed = std::hypot(2 * std::sin(t), std::cos(t));
    const double direction = std::atan2(std::cos(t), -2 * std::sin(t));
    const double before = i == 0 ? direction : g.chain.joints.back().direction;
    g.chain.joints.push_back({{at(t).x / length, at(t).y / length},
                              before + std::remainder(direction - before, 2 * M_PI),
                              2 / (speed * speed * speed) * length});
    if (i < 8) g.chain.pieces.push_back({.length = (up[i + 1] - up[i]) / length});
    for (int k = 0; k < 10 && i < 8; ++k) {
      const core::Point2 p = at(t + M_PI / 40 * k);
      g.points.push_back({.position = {p.x / length, p.y / length}});
      g.chain.feet.push_back({i, k / 10.0});
    }
  }
  g.chain.closed = true;
  g.chain.turning = 2 * M_PI;
  g.problem.points = &g.points;
  g.problem.joints = rate_joints(g.chain);
  EXPECT_EQ(g.problem.joints.size(), 4U);
  g.problem.slopes.assign(8, {-3, 3});
  for (std::size_t p = 0; p < 8; ++p)
    g.problem.growth.push_back(g.chain.joints[p + 1].curvature > g.chain.joints[p].curvature ? 1
                                                                                             : -1);
  g.problem.weights = {.tolerance = 2e-3, .energy = 300, .band = 3, .power = 4, .jump = 1};
  g.problem.end = g.chain.joints.back();
  const FitChain closed = close_rates(g.chain, g.problem);
  const RateModel before(closed, g.problem);
  EXPECT_LT(before.gaps, 1e-6);
  for (std::size_t i = 0; i <= 8; ++i)
    EXPECT_LT(core::distance(closed.joints[i].position, g.chain.joints[i].position), 0.03) << i;
  const FitJoint &first = closed.joints.front(), &last = closed.joints.back();
  EXPECT_LT(core::distance(first.position, last.position), 1e-8);
  EXPECT_NEAR(last.direction - first.direction, 2 * M_PI, 1e-7);
  EXPECT_NEAR(last.curvature, first.curvature, 1e-9);
}

}  // namespace
}  // namespace keyline::fairing::detail
