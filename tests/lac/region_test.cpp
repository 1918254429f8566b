#include "keyline/lac/hermite/region.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/lac/hermite/compound.h"

/// Which chord angles a slope can have.
namespace keyline::lac {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(DrawableRegion, IsSymmetricAboutTheCircle) {
  for (const double alpha : {-5.0, -1.0, -0.2, 1.5, 4.0})
    for (const double theta : {0.2, 1.5, 3.0}) {
      const core::Interval r = drawable_region(alpha, theta);
      EXPECT_NEAR(r.low + r.high, theta, 1e-14);
      EXPECT_GT(r.high, theta / 2);
      EXPECT_LT(r.high, theta);
    }
  for (const double alpha : {0.0, 0.5, 1.0}) EXPECT_EQ(drawable_region(alpha, 1).high, 1);
}

// Small turnings of a curve out of an inflection: tangent t^m, chord its mean 1 / (m + 1), so that
// the angle at the other end is m / (m + 1) of the turning, m = 1 - 1 / alpha.
TEST(DrawableRegion, OfSmallTurningsIsAPowers) {
  for (const double alpha : {-4.0, -1.0, -0.25}) {
    const double m = 1 - 1 / alpha;
    EXPECT_NEAR(drawable_region(alpha, 1e-4).high / 1e-4, m / (m + 1), 1e-7) << alpha;
  }
}

// A clothoid from its inflection that turns by theta, by Simpson's rule over t^2.
TEST(DrawableRegion, OfTheClothoidIsFresnels) {
  for (const double theta : {0.5, 2.0}) {
    double x = 0, y = 0;
    constexpr int kSteps = 2000;
    for (int i = 0; i <= kSteps; ++i) {
      const double t = double(i) / kSteps;
      const double w = (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2) / (3.0 * kSteps);
      x += w * std::cos(theta * t * t);
      y += w * std::sin(theta * t * t);
    }
    EXPECT_NEAR(drawable_region(-1, theta).low, std::atan2(y, x), 1e-12);
  }
}

TEST(DrawableRegion, WantsATurningBelowHalf) {
  for (const double theta : {0.0, -1.0, kPi, 4.0})
    EXPECT_THROW(static_cast<void>(drawable_region(-1, theta)), core::InvalidInput) << theta;
  EXPECT_THROW(static_cast<void>(drawable_region(1e101, 1)), core::InvalidInput);
  EXPECT_NO_THROW(static_cast<void>(drawable_region(-1, 3.14)));
}

// A millionth of the region's width inside, on the side of the angle asked for.
// The steepest slopes have the circle alone.
TEST(DrawableRegion, OfTheSteepestSlopesIsTheCircle) {
  for (const double alpha : {-1e99, -1e30, -1e16, 1e16, 1e30, 1e99})
    for (double theta = 0.1; theta < 3.1; theta += 0.1) {
      const core::Interval r = drawable_region(alpha, theta);
      EXPECT_LE(r.low, theta / 2);
      EXPECT_GE(r.high, theta / 2);
      EXPECT_NEAR(nearest_drawable(alpha, theta, 0.3 * theta).chord_angle, theta / 2, 1e-14);
    }
}

TEST(NearestDrawable, IsALittleInside) {
  for (const double alpha : {-2.0, 3.0})
    for (const double theta : {0.7, 2.0}) {
      const core::Interval r = drawable_region(alpha, theta);
      const double margin = 1e-6 * (r.high - r.low);
      const double beyond = 0.5 * (r.high + theta);
      EXPECT_NEAR(nearest_drawable(alpha, theta, beyond).chord_angle, r.high - margin, 1e-15);
      EXPECT_NEAR(nearest_drawable(alpha, theta, theta - beyond).chord_angle, r.low + margin,
                  1e-15);
      const double inside = 0.5 * (r.high + theta / 2);
      EXPECT_EQ(nearest_drawable(alpha, theta, inside).chord_angle, inside);
      EXPECT_EQ(nearest_drawable(alpha, theta, inside).alpha, alpha);
      // The nearest slope has the angle at its border, and is not farther than it has to be.
      const double slope = nearest_drawable(alpha, theta, beyond).alpha;
      EXPECT_GT(drawable_region(slope, theta).high, beyond);
      const double less = slope + (alpha - slope) * 1e-4;
      EXPECT_LT(drawable_region(less, theta).high, beyond);
      EXPECT_EQ(nearest_drawable(alpha, theta, theta - beyond).alpha, slope);
    }
}

// Angles that only the slopes from 0 to 1 have: the nearer of these two.
TEST(NearestDrawable, TheFullSlopesServeAlways) {
  EXPECT_EQ(nearest_drawable(-2, 1, 1 - 1e-12).alpha, 0);
  EXPECT_EQ(nearest_drawable(5, 1, 1 - 1e-12).alpha, 1);
  EXPECT_THROW(static_cast<void>(nearest_drawable(-1, 0, 0.5)), core::InvalidInput);
  EXPECT_THROW(static_cast<void>(nearest_drawable(-1, 2 * kPi, 0.5)), core::InvalidInput);
  EXPECT_NO_THROW(static_cast<void>(nearest_drawable(-1, 6.28, 3.5)));
}

// Found by 9 of 8,000 random requests: the full region, and rounding beyond it.
TEST(DrawableRegion, BordersStayBetweenTheTangents) {
  for (int n = 1; n < 400; ++n)
    for (const double beside : {1e-16, 3e-13}) {
      const double theta = 3e-8 * n;
      for (const core::Interval& psi :
           {drawable_region(CompoundRhythm{0.5, -beside, 0.999999}, theta),
            drawable_region(CompoundRhythm{0.5, -beside, 1e-6}, theta),
            drawable_region(-beside, theta), drawable_region(1 + beside, theta)}) {
        EXPECT_GE(psi.low, 0) << theta;
        EXPECT_LE(psi.high, theta);
      }
    }
}

}  // namespace
}  // namespace keyline::lac
