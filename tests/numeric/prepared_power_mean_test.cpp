#include "keyline/numeric/prepared_power_mean.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

TEST(PreparedPowerMean, KnownMeans) {
  for (const bool swapped : {false, true}) {
    const double a = swapped ? 4 : 1;
    const double b = swapped ? 1 : 4;
    EXPECT_NEAR(PowerMean(a, b, 1)(0.5), 2.5, 1e-15);
    EXPECT_NEAR(PowerMean(a, b, 0)(0.5), 2, 1e-15);
    EXPECT_NEAR(PowerMean(a, b, -1)(0.5), 1.6, 1e-15);
    EXPECT_NEAR(PowerMean(a, b, 2)(0.5), std::sqrt(8.5), 1e-15);
    EXPECT_NEAR(PowerMean(a, b, 1)(0.9), 0.1 * a + 0.9 * b, 1e-15);
    EXPECT_NEAR(PowerMean(a, b, -1)(0.9), 1 / (0.1 / a + 0.9 / b), 1e-15);
    EXPECT_EQ(PowerMean(a, b, 3)(0), a);
    EXPECT_EQ(PowerMean(a, b, 3)(1), b);
  }
  EXPECT_EQ(PowerMean(3, 3, 2)(0.4), 3);
}

TEST(PreparedPowerMean, EndsAtZeroAndInfinity) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(PowerMean(1, 0, 1)(0.25), 0.75, 1e-16);
  EXPECT_NEAR(PowerMean(0, 2, 2)(0.25), 1, 1e-15);
  EXPECT_NEAR(PowerMean(kInfinity, 2, -1)(0.25), 8, 1e-15);
  EXPECT_NEAR(PowerMean(2, kInfinity, -2)(0.75), 4, 1e-15);
}

}  // namespace
}  // namespace keyline::numeric
