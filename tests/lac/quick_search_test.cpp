#include "keyline/lac/hermite/quick_search.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace keyline::lac::detail {
namespace {

/// The part of the turning made by `lambda` of `q`.
double turned(double b, double lambda, double q) {
  return b == 0 ? lambda / q : std::expm1(-b * lambda) / std::expm1(-b * q);
}

/// The chord's angle above half the turning, by Simpson's rule: at lambda in [0, q] the arc length
/// passes as e^(-a lambda), the direction as e^(-b lambda).
double excess_of(double alpha, double theta, double q) {
  const double a = std::abs(alpha);
  const double b = alpha < 0 ? 1 - alpha : alpha - 1;
  constexpr int kSteps = 2000;
  double x = 0, y = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double lambda = q * i / kSteps;
    const double weight = (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2) * std::exp(-a * lambda);
    const double angle = theta * (turned(b, lambda, q) - 0.5);
    x += weight * std::cos(angle);
    y += weight * std::sin(angle);
  }
  return (alpha < 0 ? 1 : -1) * std::atan2(y, x);
}

TEST(GuessRange, IsNearTheRangeAndTellsTheBend) {
  int looked = 0;
  for (const double alpha : {-3.0, -1.0, -0.5, -0.2, 0.2, 0.5, 0.8, 1.5, 2.0, 4.0}) {
    for (const double theta : {0.2, 0.6, 1.2, 2.0}) {
      const double limit = limit_chord_angle(alpha, theta) - theta / 2;
      for (const double q : {0.05, 0.2, 0.5, 1.0, 1.5}) {
        const double excess = excess_of(alpha, theta, q);
        if (excess > 0.7 * limit) continue;
        ++looked;
        const RangeGuess guess = guess_range(decays_of(alpha), theta, excess, circle_slope(theta));
        EXPECT_NEAR(guess.range, q, 0.01 * q) << alpha << ' ' << theta;
        const double h = 1e-3 * q;
        const double after = excess_of(alpha, theta, q + h),
                     before = excess_of(alpha, theta, q - h);
        const double bend = -2 * (after - 2 * excess + before) / (h * (after - before));
        EXPECT_NEAR(guess.bend * q, bend * q, 0.05) << alpha << ' ' << theta << ' ' << q;
      }
    }
  }
  EXPECT_GT(looked, 100);
}

}  // namespace
}  // namespace keyline::lac::detail
