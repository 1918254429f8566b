#include "keyline/numeric/halving.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

TEST(LastThatHolds, IsWithinTheLastHalvingWhicheverWayItGoes) {
  for (const double limit : {0.3, 0.501, 0.999})
    for (const int halvings : {4, 11, 30}) {
      const double part = std::ldexp(1.0, -halvings);
      const double up = last_that_holds([&](double x) { return x <= limit; }, 0, 1, halvings);
      EXPECT_LE(up, limit);
      EXPECT_GT(up + part, limit);
      const double down = last_that_holds([&](double x) { return x >= limit; }, 1, 0, halvings);
      EXPECT_GE(down, limit);
      EXPECT_LT(down - part, limit);
    }
}

TEST(LastThatHolds, AsksAtNeitherEndAndLeavesTheGoodOneWhereNothingHolds) {
  std::vector<double> asked;
  const auto never = [&](double x) { return asked.push_back(x), false; };
  EXPECT_EQ(last_that_holds(never, -3, 1, 3), -3);
  EXPECT_EQ(asked, (std::vector<double>{-1, -2, -2.5}));
}

TEST(LastThatHolds, EndsWhereNoDoubleIsBetween) {
  int asked = 0;
  const double root = last_that_holds([&](double x) { return ++asked, x * x <= 2; }, 1, 2, 1000);
  EXPECT_LE(asked, 53);
  EXPECT_LE(root * root, 2 + std::numeric_limits<double>::epsilon());
  EXPECT_GT(std::nextafter(root, 2) * std::nextafter(root, 2), 2);
}

TEST(LastThatHolds, TheLastPlaceAskedThatHeldIsTheAnswer) {
  double kept = 0;
  const auto holds = [&](double x) {
    if (x < 0.7) kept = x;
    return x < 0.7;
  };
  EXPECT_EQ(last_that_holds(holds, 0, 1, 20), kept);
}

TEST(LargestShareThatHolds, IsAsSharpOfASmallShareAsOfALargeOne) {
  for (const double limit : {0.3, 7e-3, 2e-9})
    for (const int halvings : {4, 10}) {
      const double share =
          largest_share_that_holds([&](double x) { return x <= limit; }, 0.75, halvings);
      EXPECT_LE(share, limit);
      EXPECT_GE(share * (1 + std::ldexp(1.0, -halvings)), limit);
    }
}

TEST(LargestShareThatHolds, IsTheWholeWhereThatHoldsAndNothingWhereNothingDoes) {
  int asked = 0;
  EXPECT_EQ(largest_share_that_holds([&](double) { return ++asked, true; }, 0.3, 10), 0.3);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(largest_share_that_holds([](double x) { return x <= 0; }, 0.3, 10), 0);
}

}  // namespace
}  // namespace keyline::numeric
