#include "keyline/acquire/common_step.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/acquire/noise.h"

namespace keyline::acquire {
namespace {

constexpr double kInch = 25.4;

std::vector<double> multiples(const std::vector<int>& counts, double step, double from) {
  std::vector<double> values;
  for (const int count : counts) values.push_back(from + step * count);
  return values;
}

// The differences' greatest common divisor is 1, though none of them is 1.
const std::vector<int> kCounts{0, 6, 16, 31, 41, 47, 62, 72, 78, 93, 103, 118, 124, 134};

TEST(CommonStep, IsWhatValuesWereMultiplesOf) {
  for (const double step : {1.0, kInch / 96, 1 / 3.0, 40.0, std::numbers::pi * 1e-4}) {
    SCOPED_TRACE(step);
    const auto found = detail::common_step(multiples(kCounts, step, 5.3 * step), 1e-12 * step);
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, step, 1e-13 * step);
  }
}

TEST(CommonStep, IsSeenThroughDecimals) {
  std::vector<double> values = multiples(kCounts, kInch / 96, 0);
  for (double& value : values) value = std::round(1000 * value) / 1000;
  const auto found = detail::common_step(values, 0.0005);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, kInch / 96, 1e-5);
}

TEST(CommonStep, IsNoneOfNumbersByChance) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> values;
    for (int i = 0; i < 30; ++i) values.push_back(std::uniform_real_distribution(0.0, 1.0)(random));
    EXPECT_EQ(detail::common_step(values, 1e-3), 0);
    EXPECT_EQ(detail::common_step(values, 1e-15), 0);
  }
  EXPECT_FALSE(detail::common_step(multiples({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, 1, 0), 1e-12));
}

/// Upper half of an ellipse in whole pixels, times a factor, from some place on.
RawCurve half_ellipse(double factor, double from) {
  RawCurve raw;
  for (int x = -120; x <= 120; ++x) {
    const double y = std::round(60 * std::sqrt(1 - x * x / 14641.0));
    raw.points.push_back({from + factor * x, from + factor * y, 0});
  }
  return raw;
}

TEST(EstimateCommonStep, IsThePixel) {
  EXPECT_NEAR(estimate_common_step(half_ellipse(1, 0.5)), 1, 1e-12);
  EXPECT_NEAR(estimate_common_step(half_ellipse(kInch / 96, 100)), kInch / 96, 1e-12);
  EXPECT_EQ(estimate_rounding(half_ellipse(kInch / 96, 100)), 0);
  // Ordinates between the pixels: even abscissae alone are no rounding.
  RawCurve grid = half_ellipse(1, 0);
  for (core::Point3& p : grid.points) p.y = std::sqrt(p.y + 1);
  EXPECT_EQ(estimate_common_step(grid), 0);
}

TEST(EstimateCommonStep, PixelsErrByTheirRoundingInAnyUnit) {
  for (const double factor : {0.5, kInch / 96, 40.0, std::numbers::pi}) {
    SCOPED_TRACE(factor);
    const auto outline = acquire_key_line(half_ellipse(factor, 7), {});
    ASSERT_TRUE(outline);
    EXPECT_NEAR(outline->rounding, factor, 1e-11);
    EXPECT_GE(outline->noise, factor / std::sqrt(12.0) - 1e-11);
  }
  // Squares of multiples are multiples too, and exact: they leave nothing.
  RawCurve exact;
  for (int i = -20; i <= 20; ++i) exact.points.push_back({i / 3.0, i * i / 9.0, 0});
  EXPECT_NEAR(estimate_common_step(exact), 1 / 9.0, 1e-13);
  const auto parabola = acquire_key_line(exact, {});
  ASSERT_TRUE(parabola);
  EXPECT_LT(parabola->noise, 0.1 * (1 / 9.0) / std::sqrt(12.0));
  EXPECT_EQ(parabola->rounding, 0);
}

}  // namespace
}  // namespace keyline::acquire
