#include "keyline/fit/canonical.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::fit::detail {
namespace {

TEST(DecimalRounding, IsTheLastDigitThatIsWritten) {
  const auto rounding = [](std::vector<double> values) { return decimal_rounding(values); };
  EXPECT_DOUBLE_EQ(rounding({0.1, 0.25, 3}), 0.01);
  EXPECT_DOUBLE_EQ(rounding({1200, -300}), 100);
  EXPECT_DOUBLE_EQ(rounding({1.234567, 0}), 1e-6);
  EXPECT_DOUBLE_EQ(rounding({-7, 12}), 1);
  EXPECT_DOUBLE_EQ(rounding({2e-7, 5e-7}), 1e-7);
  EXPECT_EQ(rounding({M_PI, 1.0 / 3}), 0);
  EXPECT_EQ(rounding({0, 0}), 0);
  EXPECT_EQ(rounding({1, INFINITY}), 0);
}

TEST(GivenDirection, TurnsKnotsAndTheirOrder) {
  CanonicalData canonical;
  EXPECT_EQ(given_direction(canonical, {0.25, 0.5}), (std::vector<double>{0.25, 0.5}));
  canonical.reversed = true;
  EXPECT_EQ(given_direction(canonical, {0.25, 0.5}), (std::vector<double>{0.5, 0.75}));
}

}  // namespace
}  // namespace keyline::fit::detail
