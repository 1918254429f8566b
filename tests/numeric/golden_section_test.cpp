#include "keyline/numeric/golden_section.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

TEST(GoldenSection, FindsTheLeastValueWithinTheTolerance) {
  const auto kink = [](double x) { return std::abs(x - 0.3); };
  const auto parabola = [](double x) { return (x - 0.3) * (x - 0.3); };
  for (const double tolerance : {1e-2, 1e-4, 1e-7}) {
    EXPECT_NEAR(golden_section(kink, -1, 2, tolerance), 0.3, tolerance);
    EXPECT_NEAR(golden_section(parabola, -1, 2, tolerance), 0.3, tolerance);
  }
  EXPECT_NEAR(golden_section(kink, -1, 2, 1e-13), 0.3, 1e-13);
}

TEST(GoldenSection, GoesToTheEndOfWhatOnlyFallsOrRises) {
  EXPECT_NEAR(golden_section([](double x) { return std::exp(x); }, -1, 2, 1e-9), -1, 1e-9);
  EXPECT_NEAR(golden_section([](double x) { return -std::exp(x); }, -1, 2, 1e-9), 2, 1e-9);
}

/// 3 (phi - 1)^n falls below 1e-6 at n = 31; two values begin, and every step takes one.
TEST(GoldenSection, TakesOneValueAStep) {
  int asked = 0;
  golden_section([&](double x) { return ++asked, std::abs(x - 0.3); }, -1, 2, 1e-6);
  EXPECT_EQ(asked, 2 + 31);
}

/// Of places that are all infinitely bad those nearer to another place come first.
TEST(GoldenSection, ValuesNeedOnlyAnOrder) {
  const auto cost = [](double x) {
    const bool drawn = x > 0.6 && x < 0.7;
    return std::pair(drawn ? std::abs(x - 0.65) : HUGE_VAL, std::abs(x - 0.65));
  };
  EXPECT_NEAR(golden_section(cost, 0, 5, 1e-9), 0.65, 1e-9);
}

}  // namespace
}  // namespace keyline::numeric
