#include "keyline/fairing/band.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::fairing::detail {
namespace {

std::vector<FitPoint> points(std::size_t n) {
  std::vector<FitPoint> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i].position = {static_cast<double>(i), 0};
  return all;
}

// Where no limit is passed the slope of the quadratic model is that of the merit: the logarithms
// of the slacks and the springs.
TEST(Band, PullsAsItsMeritRises) {
  const auto given = points(3);
  for (const double spring : {0.0, 0.7}) {
    Band band(given, 1.0, spring);
    const std::vector<double> offsets{0.3, -0.5, 0.1};
    band.start(offsets, 0.2);
    EXPECT_EQ(band.extra(), 0);
    for (std::size_t j = 0; j < 3; ++j) {
      const double h = 1e-5;
      auto up = offsets, down = offsets;
      up[j] += h;
      down[j] -= h;
      const double slope = (band.merit(up, 0) - band.merit(down, 0)) / (2 * h);
      const double bend =
          (band.merit(up, 0) - 2 * band.merit(offsets, 0) + band.merit(down, 0)) / (h * h);
      EXPECT_NEAR(band.pull(j).slope, slope, 1e-8) << spring << ' ' << j;
      // At the start multipliers are barrier / slack, so that weights are the merit's bends.
      EXPECT_NEAR(band.pull(j).weight, bend, 1e-4 * bend) << spring << ' ' << j;
    }
  }
}

// A point to be passed has no limits: its weight and slope are its merit's, whatever its share.
TEST(Band, PointsToBePassedPullAsTheirMeritRises) {
  for (const double share : {1.0, 20.0}) {
    auto given = points(1);
    given[0].must_pass = true;
    given[0].share = share;
    Band band(given, 0.5, 0);
    const double off = 0.02 * share, h = 1e-4 * share;
    band.start({off}, 0.2);
    EXPECT_NEAR(band.extra(), 0.02, 1e-15);
    band.move({off}, {-0.5 * off}, 1);  // half of its way is meant: the rest becomes a force
    const double up = band.merit({off + h}, 0), down = band.merit({off - h}, 0);
    EXPECT_NEAR(band.pull(0).slope, (up - down) / (2 * h), 1e-6 * band.pull(0).slope) << share;
    const double bend = (up - 2 * band.merit({off}, 0) + down) / (h * h);
    EXPECT_NEAR(band.pull(0).weight, bend, 1e-6 * bend) << share;
    EXPECT_TRUE(band.allows({1e3 * share}, 1));
    EXPECT_EQ(band.longest({1e3 * share}), 1);
  }
}

// Beside an energy of 3 / 2 (x - 0.4)^2 it is passed all the same, by a force of 1.2.
TEST(Band, PointsToBePassedArePassed) {
  auto given = points(1);
  given[0].must_pass = true;
  Band band(given, 0.01, 0);
  double x = 0.3;
  band.start({x}, 0.2);
  for (int i = 0; i < 4; ++i) {
    const Pull pull = band.pull(0);
    const double by = -(3 * (x - 0.4) + pull.slope) / (3 + pull.weight);
    x += by;
    band.move({x}, {by}, 1);
  }
  EXPECT_NEAR(x, 0, 1e-12);
  EXPECT_NEAR(band.pull(0).slope, 1.2, 1e-6);
  EXPECT_EQ(band.extra(), 0);
  band.rescale(10);
  EXPECT_NEAR(band.pull(0).slope, 12, 1e-5);
}

TEST(Band, PointsArePassedToAThousandthOfTheTolerance) {
  auto given = points(2);
  given[1].must_pass = true;
  EXPECT_TRUE(all_passed(given, {0.9, 0.00099}, 1));
  EXPECT_FALSE(all_passed(given, {0, -0.00101}, 1));
  given[1].share = 100;
  EXPECT_TRUE(all_passed(given, {0, 0.099}, 1));
}

// A run's highest offset keeps to the one limit, its lowest to the other; a point may have nearer
// ones of its own.
TEST(Band, LimitsAreCountedFromARunsEnds) {
  auto given = points(3);
  given[0].high = 0.3;
  given[0].low = -0.4;
  given[1] = given[0];
  given[1].share = 0.5;
  given[2].highest = 0.6;
  given[2].lowest = -0.5;
  Band band(given, 1.0, 0);
  const double mu = 0.1;
  band.start({0.1, 0.1, 0.1}, mu);
  ASSERT_EQ(band.extra(), 0);
  EXPECT_NEAR(band.pull(0).slope, mu / (0.7 - 0.1) - mu / (0.6 + 0.1), 1e-12);
  EXPECT_NEAR(band.pull(1).slope, mu / (0.85 - 0.1) - mu / (0.8 + 0.1), 1e-12);
  EXPECT_NEAR(band.pull(2).slope, mu / (0.6 - 0.1) - mu / (0.5 + 0.1), 1e-12);
}

// Offsets that change without a step: a slack that would shrink below half of the tolerance gets
// extra width for it, which goes again where the offset goes back.
TEST(Band, ExtraWidthIsWhatOffsetsComeTooNearByThemselves) {
  const auto given = points(2);
  Band band(given, 1.0, 0);
  const double mu = 0.1;
  band.start({0.3, -0.2}, mu);
  band.rest({0.45, -0.3});
  EXPECT_EQ(band.extra(), 0);  // 0.55 and 0.7 are left
  EXPECT_NEAR(band.pull(0).slope, mu / 0.55 - mu / 1.45, 1e-12);
  band.rest({0.95, -0.7});
  EXPECT_NEAR(band.extra(), 0.45, 1e-15);
  // Slacks 0.5 and 1.95, 1.7 and 0.5; multipliers as at the start, what is extra taken back.
  EXPECT_NEAR(band.pull(0).slope, (mu + mu / 0.7 * 0.45) / 0.5 - mu / 1.95, 1e-12);
  EXPECT_NEAR(band.pull(1).slope, mu / 1.7 - (mu + mu / 0.8 * 0.2) / 0.5, 1e-12);
  band.rest({0.4, -0.2});
  EXPECT_EQ(band.extra(), 0);
}

// A limit that is passed by e: its slack s is e short, and Newton's step is to give that back:
// slope (mu + lambda e) / s with lambda = mu / s.
TEST(Band, WhatIsPassedIsTakenBack) {
  const auto given = points(2);
  Band band(given, 1.0, 0);
  const double mu = 0.2;
  band.start({1.5, -1.25}, mu);
  const double least = 1 - 1.5 + band.extra();  // of the first, which passes most
  ASSERT_GT(least, 0);
  const double first = 0.5 + least, second = 0.25 + least;
  EXPECT_NEAR(band.pull(0).slope, (mu + mu / least * first) / least - mu / 2.5, 1e-12);
  EXPECT_NEAR(band.pull(1).slope, mu / 2.25 - (mu + mu / least * second) / least, 1e-12);
}

// Half the weight times a mean of squares: of two points of weights 1 and 3 the second counts
// thrice, a point that pulls twice as much twice, a guide as one point more.
TEST(Springs, AreAMeanOfSquares) {
  auto given = points(3);
  given[1].weight = 3;
  given[1].pull = 2;
  given[2].count = 0;
  given[2].weight = 99;
  Springs springs(given, {0.1, 0.2, 0.3}, 8);
  const std::vector<double> weight{8 * 1 / 4.0, 8 * 2 * 3 / 4.0, 8 / 2.0};
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(springs.pull(j).weight, weight[j], 1e-14);
    EXPECT_NEAR(springs.pull(j).slope, weight[j] * 0.1 * double(j + 1), 1e-14);
  }
  EXPECT_NEAR(springs.merit({1, 2, 3}, 1), 0.5 * (weight[0] + 4 * weight[1] + 9 * weight[2]),
              1e-13);
  springs.move({1, 2, 3}, {}, 1);
  EXPECT_NEAR(springs.pull(1).slope, 2 * weight[1], 1e-14);
  EXPECT_EQ(springs.longest({9, 9, 9}), 1);
  EXPECT_TRUE(springs.allows({9, 9, 9}, 1));
}

// Offsets come times their share, which the mean is not.
TEST(MeanWeights, MakeTheRootMeanSquareOfTheMeasured) {
  auto given = points(3);
  given[0].weight = 2;
  given[1].share = 0.5;
  given[2].count = 0;
  const auto weight = mean_weights(given);
  EXPECT_NEAR(weight[0], 2 / 3.0, 1e-15);
  EXPECT_NEAR(weight[1], 4 / 3.0, 1e-15);
  EXPECT_EQ(weight[2], 0);
  EXPECT_NEAR(root_mean_square(weight, {0.3, 0.1, 7}), std::sqrt((2 * 0.09 + 0.04) / 3), 1e-15);
}

TEST(LargestOf, CountsTheSpreadToEitherSide) {
  auto given = points(2);
  EXPECT_EQ(largest_of(given, {0.1, -0.3}), 0.3);
  given[0].high = 0.4;
  EXPECT_NEAR(largest_of(given, {0.1, -0.3}), 0.5, 1e-15);
  given[1].low = -0.5;
  EXPECT_NEAR(largest_of(given, {0.1, -0.3}), 0.8, 1e-15);
  given[1].share = 0.1;
  EXPECT_NEAR(largest_of(given, {0.1, -0.3}), 0.5, 1e-15);
}

TEST(LimitsKept, ToTheirSlack) {
  auto given = points(2);
  given[0].highest = 0.2;
  given[1].lowest = -0.1;
  EXPECT_TRUE(limits_kept(given, {0.2, -0.1}, 0));
  EXPECT_FALSE(limits_kept(given, {0.21, 0}, 0));
  EXPECT_FALSE(limits_kept(given, {0, -0.11}, 0));
  EXPECT_TRUE(limits_kept(given, {0.21, -0.11}, 0.02));
  EXPECT_FALSE(limits_kept(given, {0.23, 0}, 0.02));
  EXPECT_FALSE(limits_kept(given, {0, -0.13}, 0.02));
}

// The whole step, or 0.995 of the way to the nearer limit.
TEST(Band, StepsEndBeforeALimit) {
  const auto given = points(2);
  Band band(given, 1.0, 0);
  band.start({0.5, -0.5}, 0.1);
  EXPECT_EQ(band.longest({0.4, -0.4}), 1);
  EXPECT_NEAR(band.longest({2, 0}), 0.995 * 0.5 / 2, 1e-14);
  EXPECT_NEAR(band.longest({-2, 0}), 0.995 * 1.5 / 2, 1e-14);
  EXPECT_NEAR(band.longest({0, -4}), 0.995 * 0.5 / 4, 1e-14);
  EXPECT_NEAR(band.longest({2, -4}), 0.995 * 0.5 / 4, 1e-14);
  EXPECT_TRUE(band.allows({0.9, -0.9}, 1));
  EXPECT_FALSE(band.allows({1.0, 0}, 1));
  EXPECT_FALSE(band.allows({0, -1.0}, 1));
  // A thousandth of the room has to be left.
  EXPECT_TRUE(band.allows({1 - 0.0006, 0}, 1));
  EXPECT_FALSE(band.allows({1 - 0.0004, 0}, 1));
  EXPECT_FALSE(band.allows({-1 + 0.0014, 0}, 1));
}

// A limit that is passed by 0.5 has extra width 0.5 + half the tolerance; a whole step takes all of
// that back, half a step half of it.
TEST(Band, ExtraWidthGoesAsTheStepDoes) {
  const auto given = points(1);
  Band band(given, 1.0, 0);
  band.start({1.5}, 0.1);
  EXPECT_NEAR(band.extra(), 1.0, 1e-15);
  // Newton's whole step to 0.9 means -0.6 and takes the extra width of 1: room 0.1 of 0.5.
  EXPECT_EQ(band.longest({-0.6}), 1);
  EXPECT_NEAR(band.longest({0.0}), 0.995 * 0.5 / 1.0, 1e-14);
  EXPECT_TRUE(band.allows({0.9}, 1));
  EXPECT_FALSE(band.allows({1.5}, 1));
  EXPECT_TRUE(band.allows({1.3}, 0.5));   // room -0.3 + half of 1
  EXPECT_FALSE(band.allows({1.6}, 0.5));  // room -0.6 + half of 1
  band.move({1.2}, {-0.6}, 0.5);
  EXPECT_NEAR(band.extra(), 0.5, 1e-15);
}

// Extra width has its price beside the logarithms: as much as twice the largest multiplier.
TEST(Band, ExtraWidthHasItsPrice) {
  const auto given = points(1);
  Band band(given, 1.0, 0);
  band.start({1.5}, 0.1);
  const double logs = -0.1 * std::log(0.5 * 2.5);  // slack 0.5 above, 2.5 below
  EXPECT_NEAR(band.merit({1.5}, 0), 2 * 0.1 / 0.5 * 1.0 + logs, 1e-13);
  const double after = -0.1 * std::log((1 - 1.2 + 0.5) * 2.2);
  EXPECT_NEAR(band.merit({1.2}, 0.5), 0.4 * 0.5 + after, 1e-13);
  band.rescale(3);
  EXPECT_NEAR(band.merit({1.2}, 0.5), 3 * 0.4 * 0.5 + after, 1e-13);
}

// Multipliers after a whole step of Newton's solve the linearised equations slack * multiplier =
// barrier: m' = (barrier + m * meant) / slack above, (barrier - m * meant) / slack below.
TEST(Band, MultipliersMoveAsNewtonsMethodMeans) {
  const auto given = points(1);
  Band band(given, 1.0, 0);
  band.start({0.2}, 0.1);
  const double meant = 0.1;
  const double high = 0.1 / 0.8, low = 0.1 / 1.2;
  const double next_high = (0.1 + high * meant) / 0.8, next_low = (0.1 - low * meant) / 1.2;
  band.move({0.3}, {meant}, 1);
  EXPECT_NEAR(band.pull(0).weight, next_high / 0.7 + next_low / 1.3, 1e-14);
  EXPECT_NEAR(band.pull(0).slope, 0.1 / 0.7 - 0.1 / 1.3, 1e-14);
  // In another unit of the energy weights are counted in that.
  const double before = band.pull(0).weight;
  band.rescale(5);
  EXPECT_NEAR(band.pull(0).weight, 5 * before, 1e-13);
  band.set_barrier(0.3);
  EXPECT_EQ(band.barrier(), 0.3);
}

// A step that means more than a multiplier can lose goes as far as 0.995 of it, all alike.
TEST(Band, MultipliersStayPositive) {
  const auto given = points(2);
  Band band(given, 1.0, 0);
  band.start({0, 0}, 0.1);
  band.move({0, 0}, {4, 0}, 0.01);
  // Above m' = (0.1 + 0.4) / 1, below (0.1 - 0.4) / 1: a loss of 0.4 of 0.1, so the share is
  // 0.995 * 0.1 / 0.4.
  const double share = 0.995 * 0.1 / 0.4;
  EXPECT_NEAR(band.pull(0).weight, (0.1 + share * 0.4) + (0.1 - share * 0.4), 1e-14);
  EXPECT_NEAR(band.pull(1).weight, 0.2, 1e-14);
  // Springs count in the slope too, with the weight of their mean.
  Band sprung(given, 1.0, 3);
  sprung.start({0.5, 0}, 0.1);
  EXPECT_NEAR(sprung.pull(0).slope, 0.1 / 0.5 - 0.1 / 1.5 + 1.5 * 0.5, 1e-14);
  sprung.rescale(2);
  EXPECT_NEAR(sprung.pull(1).weight, 2 * (0.1 + 0.1 + 1.5), 1e-14);
}

// Products of slack and multiplier stay within ten thousand times the barrier, to either side.
TEST(Band, MultipliersStayNearTheirBarrier) {
  const auto given = points(1);
  constexpr double kNear = 1e-6;
  Band band(given, 1.0, 0);
  band.start({0}, 0.1);
  band.move({1 - kNear}, {0}, 1);
  // Above the slack is 1e-6, where 0.1 / 1e-6 / 1e4 = 10 is the least; below 0.1 stays.
  EXPECT_NEAR(band.pull(0).weight, 10 / kNear + 0.1 / (2 - kNear), 1);
  Band low(given, 1.0, 0);
  low.start({0}, 0.1);
  low.move({kNear - 1}, {0}, 1);
  EXPECT_NEAR(low.pull(0).weight, 10 / kNear + 0.1 / (2 - kNear), 1);
  // Back from there a slack of 1 has a multiplier of 0.1 * 1e4 at most.
  band.set_barrier(1e-5);
  band.move({0}, {0}, 1e-9);
  EXPECT_LE(band.pull(0).weight, 1e-5 * 1e4 + 0.2);
}

// The extra width is the largest, whichever side of which point has it.
TEST(Band, ExtraIsTheLargestOfAllSides) {
  for (const double sign : {1.0, -1.0}) {
    const auto given = points(3);
    Band band(given, 1.0, 0);
    band.start({sign * 1.1, sign * 1.5, -sign * 1.3}, 0.1);
    EXPECT_NEAR(band.extra(), 1.0, 1e-15);
    EXPECT_NEAR(band.pull(2).weight, 0.1 / 0.5 / 0.5 + 0.1 / 2.3 / 2.3, 1e-14);
    band.move({sign * 1.1, sign * 1.5, -sign * 1.3}, {0, 0, 0}, 0.25);
    EXPECT_NEAR(band.extra(), 0.75, 1e-15);
  }
}

// A step that means to give back more than the extra width goes as far as 0.995 of the slack.
TEST(Band, OfExtraWidthStepsEndAtTheLowerLimitToo) {
  const auto given = points(1);
  Band band(given, 1.0, 0);
  band.start({-1.5}, 0.1);  // below: slack 0.5 with extra width 1
  EXPECT_EQ(band.longest({0.6}), 1);
  EXPECT_NEAR(band.longest({0.0}), 0.995 * 0.5, 1e-14);
  EXPECT_TRUE(band.allows({-0.9}, 1));
  EXPECT_FALSE(band.allows({-1.5}, 1));
  const double logs = -0.1 * std::log(0.5 * 2.5);
  EXPECT_NEAR(band.merit({-1.5}, 0), 2 * 0.1 / 0.5 * 1.0 + logs, 1e-13);
  // After a whole step m' = (barrier + m (extra - meant)) / slack below.
  const double low = 0.1 / 0.5, high = 0.1 / 2.5, meant = 0.8;
  band.move({-0.7}, {meant}, 1);
  const double next_low = (0.1 + low * (1 - meant)) / 0.5;
  const double next_high = (0.1 + high * meant) / 2.5;
  EXPECT_NEAR(band.pull(0).weight, next_low / 0.3 + next_high / 1.7, 1e-13);
}

}  // namespace
}  // namespace keyline::fairing::detail
