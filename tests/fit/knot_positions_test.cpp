#include "keyline/fit/knot_positions.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace keyline::fit::detail {
namespace {

/// Values of a cubic spline with a simple knot at 0.3 and a kink at 0.6.
SplineData known_knots() {
  SplineData data;
  data.columns.resize(2);
  for (int i = 0; i <= 120; ++i) {
    const double t = i / 120.0;
    const double a = std::max(0.0, t - 0.3), b = std::max(0.0, t - 0.6);
    data.parameters.push_back(t);
    data.columns[0].push_back(t * t + 5 * a * a * a + b);
    data.columns[1].push_back(1 - t - 3 * a * a * a + 2 * b * b - b);
  }
  return data;
}

TEST(KnotGroups, AreTheKnotsAgain) {
  const std::vector<double> knots{0.1, 0.4, 0.4, 0.4, 0.7, 0.9, 0.9};
  const auto groups = grouped(knots);
  ASSERT_EQ(groups.size(), 4u);
  const std::vector<std::size_t> times{1, 3, 1, 2};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(groups[i].multiplicity, times[i]);
  EXPECT_EQ(flattened(groups), knots);
  EXPECT_TRUE(grouped({}).empty());
}

TEST(OptimisePositions, FindsTheKnotsTheDataWereMadeOf) {
  for (const std::size_t threads : {1, 3}) {
    std::vector<SplineSolver> solvers(threads, SplineSolver(known_knots(), {0, 1}, 4));
    const auto found = optimise_positions(solvers, grouped({0.22, 0.64, 0.64, 0.64}), 0, 2, 100);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0].at, 0.3, 1e-5);
    EXPECT_NEAR(found[1].at, 0.6, 1e-5);
    EXPECT_EQ(found[1].multiplicity, 3u);
    EXPECT_LT(solvers[0].sum_of_squares(flattened(found)), 1e-12);
  }
}

TEST(OptimisePositions, MovesThoseAskedForAndMakesNothingWorse) {
  const auto start = grouped({0.15, 0.33, 0.5, 0.64, 0.64, 0.64, 0.9});
  std::vector<SplineSolver> solvers(1, SplineSolver(known_knots(), {0, 1}, 4));
  const double before = solvers[0].sum_of_squares(flattened(start));
  for (std::size_t first = 0; first < start.size(); ++first) {
    const auto found = optimise_positions(solvers, start, first, first + 1, 50);
    double last = 0;
    for (std::size_t i = 0; i < start.size(); ++i) {
      if (i != first) {
        EXPECT_EQ(found[i].at, start[i].at);
      }
      EXPECT_EQ(found[i].multiplicity, start[i].multiplicity);
      EXPECT_GT(found[i].at, last);
      last = found[i].at;
    }
    EXPECT_LT(last, 1);
    const double after = solvers[0].sum_of_squares(flattened(found));
    EXPECT_LT(after, before);
    // A minimum: neither beside the place it was put is better.
    for (const double by : {-1e-3, 1e-3}) {
      auto beside = found;
      beside[first].at += by;
      EXPECT_GE(solvers[0].sum_of_squares(flattened(beside)), after * (1 - 1e-6));
    }
  }
  const auto none = optimise_positions(solvers, start, 2, 2, 50);
  EXPECT_EQ(flattened(none), flattened(start));
}

}  // namespace
}  // namespace keyline::fit::detail
