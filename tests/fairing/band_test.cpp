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

}  // namespace
}  // namespace keyline::fairing::detail
