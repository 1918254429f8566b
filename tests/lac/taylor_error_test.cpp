#include "keyline/lac/segment/taylor_error.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace keyline::lac {
namespace {

// Of a circle of radius r about its start: x = r sin(theta), y = r (1 - cos(theta)), whose series
// alternate, so that the first term left out is the remainder but for a little of it. The largest
// is that of the far end.
TEST(TaylorErrors, OfACircleAreTheFirstTermsLeftOut) {
  for (const double r : {0.02, 5.0}) {
    constexpr double kTurning = 0.5;
    const Segment circle{{{3, -2}, 1.1}, 1, r * kTurning, 1 / r, 1 / r};
    for (const auto variable : {TaylorVariable::tangent_angle, TaylorVariable::arc_length}) {
      const auto errors = taylor_errors(circle, variable, 0, 9);
      ASSERT_TRUE(errors);
      EXPECT_TRUE(errors->converges);
      ASSERT_EQ(errors->degrees.size(), 9U);
      double term = kTurning;  // theta^k / k!
      for (int k = 1; k <= 9; ++k) {
        const TaylorError& e = errors->degrees[k - 1];
        term *= kTurning / (k + 1);
        const double next = term * kTurning / (k + 2);
        EXPECT_EQ(e.degree, k);
        EXPECT_NEAR(e.largest, r * std::hypot(term, next), r * next * kTurning + 1e-15 * r) << k;
        EXPECT_GE(e.bound, e.largest - 1e-15 * r);
        // at the best radius of Cauchy's estimate, k + 1 (Stirling): no more than that
        EXPECT_LE(e.bound, 20 * std::sqrt(2 * std::numbers::pi * (k + 1)) * e.largest) << k;
      }
    }
  }
}

// In the middle of a circle either half is as far off.
TEST(TaylorErrors, AboutTheMiddleReachHalfAsFar) {
  const Segment circle{{}, 1, 1, 0.6, 0.6};
  const auto errors = taylor_errors(circle, TaylorVariable::arc_length, 0.5, 4);
  ASSERT_TRUE(errors);
  double term = 0.3;
  for (int k = 1; k <= 4; ++k) {
    term *= 0.3 / (k + 1);
    const double next = term * 0.3 / (k + 2);
    EXPECT_NEAR(errors->degrees[k - 1].largest, std::hypot(term, next) / 0.6, next * 0.3) << k;
  }
}

}  // namespace
}  // namespace keyline::lac
