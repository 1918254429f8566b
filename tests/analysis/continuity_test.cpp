#include "keyline/analysis/continuity.h"

#include <array>
#include <limits>

#include <gtest/gtest.h>

#include "keyline/curve/bezier.h"

#include "spirals.h"

namespace keyline::analysis {
namespace {

using testing::SpiralCurve;

core::Pose2 end_of(const SpiralCurve& c) {
  return {evaluate(c, 1), c.start.direction + c.turning(c.length)};
}

int order_after(const SpiralCurve& first, const SpiralCurve& second) {
  return continuity(std::vector<SpiralCurve>{first, second}).at(0).order;
}

TEST(Continuity, OrdersOfJoints) {
  const SpiralCurve first = testing::clothoid(0, 1, 1);
  const core::Pose2 end = end_of(first);
  EXPECT_EQ(order_after(first, testing::clothoid(1, 2, 1, end)), 3);
  EXPECT_EQ(order_after(first, testing::arcs({1}, {1}, end)), 2);
  EXPECT_EQ(order_after(first, testing::arcs({2}, {1}, end)), 1);
  EXPECT_EQ(order_after(first, testing::arcs({1}, {1}, {end.position, end.direction + 0.1})), 0);
  const core::Point2 off = end.position + core::Vector2{0.01, 0};
  EXPECT_EQ(order_after(first, testing::arcs({1}, {1}, {off, end.direction})), -1);
}

// On either side of each tolerance of the guide's table.
TEST(Continuity, OrdersEndAtTheirTolerances) {
  const SpiralCurve first = testing::clothoid(0, 1, 1);
  const core::Pose2 end = end_of(first);
  const auto beside = [&](double share) {
    const core::Point2 off = end.position + core::Vector2{share * 1e-6, 0};
    const core::Pose2 turned{end.position, end.direction + share * 1e-4};
    return std::array{order_after(first, testing::clothoid(1, 2 + share * 1e-2, 1, end)),
                      order_after(first, testing::clothoid(1 + share * 1e-3, 3, 1, end)),
                      order_after(first, testing::clothoid(1, 3, 1, turned)),
                      order_after(first, testing::clothoid(1, 3, 1, {off, end.direction}))};
  };
  EXPECT_EQ(beside(0.8), (std::array{3, 2, 2, 2}));
  EXPECT_EQ(beside(1.3), (std::array{2, 1, 0, -1}));
}

// The last handle lies in the end point, as fonts and drawings have it: travel came along the line.
TEST(Continuity, AHandleDrawnInAtTheEndTurnsNothing) {
  const curve::Bezier2 first{{{0, 0}, {0, 0}, {3, 0}, {3, 0}}, {}};
  const curve::Bezier2 next{{{3, 0}, {3, 0}, {5, 0}, {5, 0}}, {}};
  const auto joints = continuity(std::vector{first, next});
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(joints[0].angle, 0);
  EXPECT_GE(joints[0].order, 1);
}

TEST(Continuity, JumpsAreMeasured) {
  const SpiralCurve first = testing::clothoid(0, 1, 1);
  core::Pose2 start = end_of(first);
  start.position = start.position + core::Vector2{3e-4, 4e-4};
  start.direction += 0.02;
  const auto joint = continuity(std::vector<SpiralCurve>{first, testing::arcs({2}, {1}, start)})[0];
  EXPECT_NEAR(joint.gap, 5e-4, 1e-12);
  EXPECT_NEAR(joint.angle, 0.02, 1e-12);
  EXPECT_NEAR(joint.curvature_jump.value(), 1, 1e-12);
  EXPECT_NEAR(joint.curvature_rate_jump.value(), -1, 1e-9);
}

// No jump is told where one of the two is infinite; nor is it taken for none.
TEST(Continuity, InfiniteCurvaturesAreNotCompared) {
  const double infinity = std::numeric_limits<double>::infinity();
  const curve::Jet2 straight{{0, 0}, {1, 0}, {}, {}};
  const curve::Jet2 cusp{{0, 0}, {1, 0}, {0, infinity}, {0, -infinity}};
  const auto sharp = joint_continuity(straight, cusp, 1);
  EXPECT_EQ(sharp.order, 1);
  EXPECT_FALSE(sharp.curvature_jump || sharp.relative_curvature_jump);
  EXPECT_FALSE(sharp.curvature_rate_jump || sharp.relative_curvature_rate_jump);
  const auto steep = joint_continuity(straight, {{0, 0}, {1, 0}, {}, {0, infinity}}, 1);
  EXPECT_EQ(steep.order, 2);
  EXPECT_EQ(steep.curvature_jump, 0);
  EXPECT_FALSE(steep.curvature_rate_jump);
}

TEST(Continuity, ClosedLoopsHaveOneJointMore) {
  const SpiralCurve half = testing::arcs({1}, {core::kPi});
  const SpiralCurve other = testing::arcs({1}, {core::kPi}, end_of(half));
  EXPECT_EQ(continuity(std::vector<SpiralCurve>{half, other}).size(), 1u);
  const auto joints = continuity(std::vector<SpiralCurve>{half, other}, true);
  ASSERT_EQ(joints.size(), 2u);
  EXPECT_EQ(joints[1].order, 3);
  EXPECT_TRUE(continuity(std::vector<SpiralCurve>{}).empty());
}

TEST(Continuity, BreakpointsInsideACurve) {
  const auto joints = inner_continuity(view(testing::arcs({1, 2}, {1, 2})));
  ASSERT_EQ(joints.size(), 1u);
  EXPECT_EQ(joints[0].joint.order, 1);
  EXPECT_NEAR(joints[0].joint.curvature_jump.value(), 1, 1e-9);
}

// Jumps are told beside the larger side, but no less than one over the size, and its square for the
// rate: 0.01 beside 1/2, 0.01 beside 1/4.
TEST(Continuity, SmallJumpsAreToldBesideTheSize) {
  const auto along = [](double curvature, double rate) {
    return curve::Jet2{{0, 0}, {1, 0}, {0, curvature}, {-curvature * curvature, rate}};
  };
  const auto joint = joint_continuity(along(0, 0.02), along(0.01, 0.03), 2, {});
  EXPECT_NEAR(joint.relative_curvature_jump.value(), 0.02, 1e-12);
  EXPECT_NEAR(joint.relative_curvature_rate_jump.value(), 0.04, 1e-12);
  const auto large = joint_continuity(along(4, 0), along(3, -5), 2, {});
  EXPECT_NEAR(large.relative_curvature_jump.value(), 0.25, 1e-12);
  EXPECT_NEAR(large.relative_curvature_rate_jump.value(), 1, 1e-12);
}

}  // namespace
}  // namespace keyline::analysis
