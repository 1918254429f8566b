#include "keyline/lac/hermite/standard_bounds.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::lac {
namespace {

// rho^alpha = 1 + alpha lambda s (e^{lambda s} for 0) and rho^(alpha-1) = 1 + (alpha-1) lambda
// theta: where rho comes to 0 or leaves all bounds.
TEST(StandardBounds, AreWhereTheRadiusEnds) {
  const auto below = standard_bounds(-2, 0.5);
  EXPECT_EQ(below.s_high, 1.0);
  EXPECT_FALSE(below.s_low);
  EXPECT_NEAR(*below.theta_high, 2 / 3.0, 1e-15);
  EXPECT_FALSE(below.theta_low);
  const auto between = standard_bounds(0.5, 2);
  EXPECT_EQ(between.s_low, -1.0);
  EXPECT_FALSE(between.s_high);
  EXPECT_EQ(between.theta_high, 1.0);
  const auto above = standard_bounds(3, 0.5);
  EXPECT_NEAR(*above.s_low, -2 / 3.0, 1e-15);
  EXPECT_EQ(above.theta_low, -1.0);
  EXPECT_FALSE(above.theta_high);
  const auto nielsen = standard_bounds(0, 1);
  EXPECT_FALSE(nielsen.s_low || nielsen.s_high || nielsen.theta_low);
  EXPECT_EQ(nielsen.theta_high, 1.0);
  const auto spiral = standard_bounds(1, 1);
  EXPECT_EQ(spiral.s_low, -1.0);
  EXPECT_FALSE(spiral.theta_low || spiral.theta_high);
  const auto circle = standard_bounds(-2, 0);
  EXPECT_FALSE(circle.s_low || circle.s_high || circle.theta_low || circle.theta_high);
}

}  // namespace
}  // namespace keyline::lac
