#include "keyline/lac/g2/blend.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/polyline.h"

namespace keyline::lac {
namespace {

using core::Pose2;

void expect_meets(const BlendSolution& blend, const BlendEnd& from, const BlendEnd& to, int order) {
  const double chord = distance(from.pose.position, to.pose.position);
  const Piece& first = blend.chain.pieces.front();
  const Piece& last = blend.chain.pieces.back();
  const Pose2 end = end_pose(blend.chain);
  EXPECT_EQ(blend.chain.start.position, from.pose.position);
  EXPECT_NEAR(core::wrap_angle(blend.chain.start.direction - from.pose.direction), 0, 1e-12);
  EXPECT_LT(distance(end.position, to.pose.position), 2e-12 * chord);
  EXPECT_NEAR(core::wrap_angle(end.direction - to.pose.direction), 0, 1e-12);
  const double size = std::max({std::abs(from.curvature), std::abs(to.curvature), 1 / chord});
  EXPECT_LT(largest_joint_gap(blend.chain).curvature, 1e-12 * size);
  if (order < 2) return;
  EXPECT_NEAR(first.curvature_start, from.curvature, 1e-12 * size);
  EXPECT_NEAR(last.curvature_end, to.curvature, 1e-12 * size);
  if (order < 3) return;
  const auto near = [&](double rate, double wanted) {
    EXPECT_NEAR(rate, wanted, 1e-9 * (std::abs(wanted) + size / chord));
  };
  near(curvature_rate(first, 0), from.curvature_rate);
  near(curvature_rate(last, 1), to.curvature_rate);
}

TEST(Blend, JoinsBezierCurvesToEveryOrder) {
  const curve::Bezier2 a{{{0, 0}, {1, 0}, {2, 0.5}, {2.5, 1.5}}, {}};
  const curve::Bezier2 b{{{5, 3}, {6, 3.2}, {7, 2.5}, {8, 1}}, {}};
  const BlendEnd from = blend_leaving(a, 0.9);
  const BlendEnd to = blend_joining(b, 0.1);
  for (const double alpha : {-1.0, -2.0, -0.5}) {
    for (const int order : {1, 2, 3}) {
      SCOPED_TRACE(std::to_string(alpha) + " G" + std::to_string(order));
      const auto blend = solve_blend(from, to, BlendOrder{order}, alpha);
      ASSERT_TRUE(blend) << blend.error().message;
      expect_meets(*blend, from, to, order);
    }
  }
}

// At a corner the part before it is left, the part behind it joined; where curvature jumps, too.
TEST(Blend, LeavesThePartBeforeAndJoinsThePartBehind) {
  const curve::Polyline2 corner{{{0, 0}, {1, 0}, {1, 1}}};
  EXPECT_EQ(blend_leaving(corner, 0.5).pose, (core::Pose2{{1, 0}, 0}));
  EXPECT_NEAR(blend_joining(corner, 0.5).pose.direction, core::kPi / 2, 1e-15);
  EXPECT_EQ(blend_leaving(corner, 0).pose.direction, 0);
  EXPECT_NEAR(blend_joining(corner, 1).pose.direction, core::kPi / 2, 1e-15);
  const Chain bend{{{0, 0}, 0}, {{-1, 1, 0, 0}, {-1, 1, 1, 1}}, false};
  EXPECT_EQ(blend_leaving(bend, 0.5).curvature, 0);
  EXPECT_EQ(blend_joining(bend, 0.5).curvature, 1);
  const curve::Bezier2 drawn_in{{{0, 0}, {1, 0}, {2, 1}, {2, 1}}, {}};
  EXPECT_NEAR(blend_leaving(drawn_in, 1).pose.direction, core::kPi / 4, 1e-15);
}

TEST(Blend, KeepsTheSignOfCurvatureForSlopesFromZeroOn) {
  const BlendEnd from{{{0, 0}, -0.6}, 0.8, 0.3};
  const BlendEnd to{{{2, 0}, 0.7}, 0.6, 0.2};
  for (const double alpha : {0.0, 0.5, 1.0}) {
    for (const int order : {1, 2, 3}) {
      SCOPED_TRACE(std::to_string(alpha) + " G" + std::to_string(order));
      const auto blend = solve_blend(from, to, BlendOrder{order}, alpha);
      ASSERT_TRUE(blend) << blend.error().message;
      expect_meets(*blend, from, to, order);
      for (const Piece& p : blend->chain.pieces) EXPECT_GT(p.curvature_end, 0);
      EXPECT_TRUE(blend->overridden.empty());
    }
  }
}

TEST(Blend, RandomRequestsAreMet) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> any(-1, 1);
  int solved = 0;
  for (int i = 0; i < 80; ++i) {
    const BlendEnd from{{{0, 0}, any(random)}, any(random), any(random)};
    const BlendEnd to{{{2, 0.3}, any(random)}, any(random), any(random)};
    const double alpha = i % 2 == 0 ? -1 : -0.6 - std::abs(any(random));
    const auto blend = solve_blend(from, to, BlendOrder::g3, alpha);
    if (!blend) continue;
    ++solved;
    expect_meets(*blend, from, to, 3);
  }
  EXPECT_GE(solved, 78);
}

/// Seven lengths of the outer pieces are tried, which proves nothing where none of them serves.
TEST(Blend, RatesThatAreNotMetAreNoProofThatNoneMeetsThem) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  int missed = 0;
  for (int i = 0; i < 60; ++i) {
    const BlendEnd from{
        {{0, 0}, -0.6 + 0.3 * any(random)}, 0.5 + 0.4 * any(random), 1e5 * any(random)};
    const BlendEnd to{
        {{2, 0}, 0.7 + 0.3 * any(random)}, 0.5 + 0.4 * any(random), 1e5 * any(random)};
    const auto blend = solve_blend(from, to, BlendOrder::g3, 1);
    if (blend || !solve_blend(from, to, BlendOrder::g2, 1)) continue;
    ++missed;
    EXPECT_EQ(blend.error().code, core::ErrorCode::not_converged);
  }
  EXPECT_GT(missed, 0);
}

TEST(Blend, RunsBothWays) {
  const BlendEnd from{{{0, 0}, 0.4}, 0.3, 0.1};
  const BlendEnd to{{{3, 1}, -0.5}, -0.2, 0.4};
  const auto there = solve_blend(from, to, BlendOrder::g3, -1);
  const auto back = solve_blend(opposite(to), opposite(from), BlendOrder::g3, -1);
  ASSERT_TRUE(there && back);
  EXPECT_LT(distance(evaluate(there->chain, 0.3), evaluate(back->chain, 0.7)), 1e-9);
}

/// Directions pi - e off the chord at both ends: an arc of (pi - e) / sin e chords, 4,503.6 (1e-12
/// by the 2.2e-16 of doubles) at e = 6.9756e-4.
TEST(Blend, RefusesACircleNearlyFullAndTellsTheNearest) {
  const auto ask = [](double e, double curvature, BlendOrder order) {
    return solve_blend({{{0, 0}, core::kPi - e}, curvature, 0},
                       {{{2, 0}, -core::kPi + e}, curvature, 0}, order, -1);
  };
  EXPECT_TRUE(ask(7.0e-4, 0, BlendOrder::g1));
  for (const double e : {6.95e-4, 1e-7, 1e-11}) {
    const auto none = ask(e, 0, BlendOrder::g1);
    ASSERT_FALSE(none) << e;
    EXPECT_EQ(none.error().code, core::ErrorCode::undrawable);
    EXPECT_NE(none.error().hint.find("0.001395 rad"), std::string::npos) << none.error().hint;
  }
  for (const BlendOrder order : {BlendOrder::g2, BlendOrder::g3}) EXPECT_FALSE(ask(1e-9, 0, order));
}

/// A loop of the radius that is asked for is no longer than that, however near its ends lie.
TEST(Blend, GoesRoundACircleThatIsAskedFor) {
  const double e = 1e-5;  // half the angle over the chord, radius 1
  const auto loop =
      solve_blend({{{0, 0}, core::kPi - e}, -1, 0}, {{{2 * std::sin(e), 0}, -core::kPi + e}, -1, 0},
                  BlendOrder::g2, -1);
  ASSERT_TRUE(loop) << loop.error().message;
  EXPECT_NEAR(arc_length(loop->chain), 2 * core::kPi - 2 * e, 1e-9);
}

}  // namespace
}  // namespace keyline::lac
