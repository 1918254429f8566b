#include "keyline/numeric/lawson.h"

#include <array>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

TEST(LawsonWeights, AreTheirDistancesWithTheirNumberForASum) {
  std::array<double, 3> weights{1, 2, 1};
  lawson_weights(weights, std::array<double, 3>{0, 1, 2});
  // 0.002, 2.004 and 2.002, together 4.008
  EXPECT_NEAR(weights[0], 0.006 / 4.008, 1e-15);
  EXPECT_NEAR(weights[1], 6.012 / 4.008, 1e-15);
  EXPECT_NEAR(weights[2], 6.006 / 4.008, 1e-15);
}

TEST(LawsonWeights, AreOneWhereNothingIsOff) {
  std::array<double, 2> weights{0.3, 1.7};
  lawson_weights(weights, std::array<double, 2>{0, 0});
  EXPECT_EQ(weights, (std::array<double, 2>{1, 1}));
}

TEST(PushedWeight, GrowsWithTheSquareOfTheShare) {
  EXPECT_DOUBLE_EQ(pushed_weight(3, 1, 0.5, {0.25, 2}), 3 * 0.75);
  EXPECT_DOUBLE_EQ(pushed_weight(3, 1, 2, {0.25, 2}), 3 * 8.25);
  EXPECT_EQ(pushed_weight(9e3, 1, 2, {0.25, 2}), 1e4);  // of what it was at the start
  EXPECT_EQ(pushed_weight(9e3, 0.5, 2, {0.25, 2}), 5e3);
  EXPECT_DOUBLE_EQ(pushed_weight(9e3, 40, 2, {0.25, 2}), 9e3 * 8.25);
}

}  // namespace
}  // namespace keyline::numeric
