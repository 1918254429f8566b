#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "keyline/fit/knot_polish.h"
#include "keyline/numeric/random.h"

namespace keyline::fit::detail {
namespace {

/// A gentle bend with a sharp bump at 0.7, and a little noise.
SplineData bump(std::size_t n) {
  SplineData data;
  data.columns.emplace_back();
  numeric::Random random(3);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(n - 1);
    data.parameters.push_back(t);
    data.columns[0].push_back(t * t + std::exp(-std::pow((t - 0.7) / 0.02, 2)) +
                              1e-3 * random.normal());
  }
  return data;
}

BayesCriterion criterion_of(const SplineData& data) {
  return {static_cast<double>(data.parameters.size()), 4, 0, 0};
}

// [Fairing] Eq. 5: N ln Q + ln N (2 n + m).
TEST(BayesCriterion, IsThatOfThePaper) {
  const BayesCriterion plain{100, 4, 0, 0};
  EXPECT_NEAR(plain(0.5, 3), 100 * std::log(0.5) + std::log(100.0) * 10, 1e-12);
  EXPECT_EQ(plain(0.5, 48), plain.value(0.5, 48));  // 2 n + m = N
  EXPECT_EQ(plain(0.5, 49), HUGE_VAL);
  EXPECT_LT(plain.value(0.5, 49), HUGE_VAL);
  EXPECT_EQ(plain(HUGE_VAL, 1), HUGE_VAL);
  const BayesCriterion few{3, 4, 0, 0};
  EXPECT_LT(few(0.5, 0), HUGE_VAL);  // without knots there is always a fit
  const BayesCriterion floored{100, 4, 0.1, 0.02};
  EXPECT_EQ(floored(0.01, 2), floored(0.08, 2));
  EXPECT_NEAR(floored(0.5, 2), 100 * std::log(0.52) + std::log(100.0) * 8, 1e-12);
}

TEST(RefinedKnots, StandWhereTheDataBendAndNoneIsIdle) {
  for (const bool thorough : {false, true}) {
    const SplineData data = bump(300);
    SplineSolver solver(data, {0, 1}, 4);
    const BayesCriterion criterion = criterion_of(data);
    const auto score = [&](const std::vector<double>& knots) {
      return criterion(solver.sum_of_squares(knots), knots.size());
    };
    const ScoredKnots found = refined_knots(solver, criterion, thorough);
    EXPECT_EQ(found.bic, score(found.knots));
    EXPECT_TRUE(std::ranges::is_sorted(found.knots));
    ASSERT_GE(found.knots.size(), 4u);
    EXPECT_LE(found.knots.size(), 14u);
    EXPECT_GE(std::ranges::count_if(found.knots, [](double t) { return std::abs(t - 0.7) < 0.08; }),
              4);
    for (std::size_t i = 0; i < found.knots.size(); ++i) {
      std::vector<double> fewer = found.knots;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_GE(score(fewer), found.bic);
    }
    // The noise alone is left.
    EXPECT_LT(std::sqrt(solver.sum_of_squares(found.knots) / 300), 1.1e-3);
  }
}

TEST(RefinedKnots, OfACubicAreNone) {
  SplineData data;
  data.columns.emplace_back();
  numeric::Random random(3);
  for (int i = 0; i <= 100; ++i) {
    const double t = i / 100.0;
    data.parameters.push_back(t);
    data.columns[0].push_back(t * t * t - t + 1e-3 * random.normal());
  }
  SplineSolver solver(data, {0, 1}, 4);
  EXPECT_TRUE(refined_knots(solver, criterion_of(data), true).knots.empty());
}

TEST(PolishKnots, ReachesTheKnotsTheDataWereMadeOfFromFarOnes) {
  SplineData data;
  data.columns.emplace_back();
  numeric::Random random(9);
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 200.0;
    data.parameters.push_back(t);
    data.columns[0].push_back(std::pow(std::max(0.0, t - 0.4), 3) * 40 -
                              std::pow(std::max(0.0, t - 0.75), 3) * 90 + 1e-4 * random.normal());
  }
  std::vector<SplineSolver> solvers(1, SplineSolver(data, {0, 1}, 4));
  const BayesCriterion criterion = criterion_of(data);
  const double truth = criterion(solvers[0].sum_of_squares(std::vector<double>{0.4, 0.75}), 2);
  for (const std::vector<double>& start : {std::vector<double>{},
                                           {0.1, 0.2, 0.3},
                                           {0.5},
                                           {0.7, 0.7, 0.7},
                                           {0.05, 0.4, 0.6, 0.75, 0.9}}) {
    const ScoredKnots found = polish_knots(solvers, criterion, start, 200, {}, true);
    EXPECT_LE(found.bic, truth);
    EXPECT_EQ(found.bic, criterion(solvers[0].sum_of_squares(found.knots), found.knots.size()));
    ASSERT_EQ(found.knots.size(), 2u);
    EXPECT_NEAR(found.knots[0], 0.4, 0.01);
    EXPECT_NEAR(found.knots[1], 0.75, 0.01);
  }
}

}  // namespace
}  // namespace keyline::fit::detail
