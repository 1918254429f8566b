#include "keyline/fairing/condense.h"

#include <cmath>

#include <gtest/gtest.h>

/// Points as the fit takes them, by hand.
namespace keyline::fairing::detail {
namespace {

using core::Point2;

TEST(Condense, LeavesFewPointsAsTheyAre) {
  const std::vector<Point2> points{{0, 0}, {1, 2}, {3, 4}};
  const std::vector<double> weights{2, 5, 7};
  for (const std::size_t most : {3U, 10U}) {
    const auto fit = condense(points, weights, most);
    ASSERT_EQ(fit.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(fit[i].position, points[i]);
      EXPECT_EQ(fit[i].weight, weights[i]);
      EXPECT_EQ(fit[i].count, 1);
    }
    EXPECT_EQ(condense(points, {}, most)[1].weight, 1);
  }
}

// Runs of two about the line through their neighbours' means: offsets to the left are positive.
TEST(Condense, SpreadsAreOfTheLeftNormal) {
  const std::vector<Point2> points{{0, 0}, {1, 0.5}, {2, -0.1}, {3, 0.2}, {4, 0.2}, {5, 0}};
  const auto fit = condense(points, {}, 4);
  ASSERT_EQ(fit.size(), 4U);
  const core::Vector2 along = fit[2].position - fit[0].position;
  const double size = std::hypot(along.x, along.y);
  double low = 0, high = 0;
  for (const int i : {1, 2}) {
    const core::Vector2 from = points[i] - fit[1].position;
    const double left = (along.x * from.y - along.y * from.x) / size;
    low = std::min(low, left);
    high = std::max(high, left);
  }
  EXPECT_NEAR(fit[1].low, low, 1e-15);
  EXPECT_NEAR(fit[1].high, high, 1e-15);
  EXPECT_LT(low, -0.2);
  EXPECT_GT(high, 0.2);
  EXPECT_EQ(fit[0].high, 0);
  EXPECT_EQ(fit[1].weight, 2);
  EXPECT_EQ(fit[1].count, 2);
}

// A run's ends stay, the rest is parted evenly: of 12 points ten make five runs of two.
TEST(CondensedIndex, IsTheRunOfAPoint) {
  const std::vector<std::size_t> of{0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6};
  for (std::size_t j = 0; j < 12; ++j) EXPECT_EQ(condensed_index(j, 12, 7), of[j]) << j;
  for (std::size_t j = 0; j < 12; ++j) EXPECT_EQ(condensed_index(j, 12, 12), j);
}

// Whatever the numbers: every run as many as condense() counted.
TEST(CondensedIndex, AgreesWithWhatWasCondensed) {
  for (std::size_t n = 5; n < 60; n += 7)
    for (std::size_t most = 3; most < n; most += 3) {
      const std::vector<Point2> points(n);
      const auto fit = condense(points, {}, most);
      std::vector<double> count(most, 0);
      for (std::size_t j = 0; j < n; ++j) ++count[condensed_index(j, n, most)];
      ASSERT_EQ(fit.size(), most);
      for (std::size_t b = 0; b < most; ++b) EXPECT_EQ(count[b], fit[b].count) << n << ' ' << most;
    }
}

TEST(CutDigits, LeavesThirtyThreeBits) {
  std::vector<FitPoint> points(1);
  points[0].position = {0.3, -0.7};
  points[0].low = -0.01;
  points[0].high = 0.02;
  const auto cut = cut_digits(points);
  const double step = std::ldexp(1.0, -33);
  for (const auto& [from, to] : {std::pair{0.3, cut[0].position.x},
                                 {-0.7, cut[0].position.y},
                                 {-0.01, cut[0].low},
                                 {0.02, cut[0].high}}) {
    EXPECT_NEAR(to, from, step / 2);
    EXPECT_EQ(std::remainder(to, step), 0);
    EXPECT_NE(to, from);
  }
  points[0].position.x += step / 100;
  EXPECT_EQ(cut_digits(points)[0].position.x, cut[0].position.x);
}

}  // namespace
}  // namespace keyline::fairing::detail
