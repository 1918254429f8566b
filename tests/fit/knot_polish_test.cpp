#include "keyline/fit/knot_polish.h"

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/numeric/random.h"

namespace keyline::fit::detail {
namespace {

/// A roof with its ridge at 0.5 over a gentle bend, with noise.
SplineData roof() {
  SplineData data;
  data.columns.emplace_back();
  numeric::Random random(7);
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 200.0;
    data.parameters.push_back(t);
    data.columns[0].push_back(std::abs(t - 0.5) + 0.1 * t * t + 1e-3 * random.normal());
  }
  return data;
}

// A spline of order 5 has a kink at a knot of multiplicity 4; knots between two data follow them
// hardly better and bend as fast as they like there.
TEST(UnitedKnots, AKinkIsOneKnot) {
  const SplineData data = roof();
  SplineSolver solver(data, {0, 1}, 5);
  const BayesCriterion criterion{static_cast<double>(data.parameters.size()), 5, 0, 0};
  const auto scored = [&](const std::vector<double>& knots) {
    return ScoredKnots{knots, criterion(solver.sum_of_squares(knots), knots.size())};
  };
  const ScoredKnots needle = scored({0.2, 0.4999, 0.5001, 0.5003, 0.5006});
  const ScoredKnots kink = united_knots(solver, criterion, needle, 2);
  ASSERT_EQ(kink.knots.size(), 5U);
  EXPECT_EQ(kink.knots[0], 0.2);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(kink.knots[i], 0.500225, 1e-12);
  EXPECT_EQ(kink.bic, scored(kink.knots).bic);
  EXPECT_LE(kink.bic, needle.bic + 2);
  // a fifth one would tear the spline; and what costs more is left
  const auto places = [&](const std::vector<double>& knots, double loss) {
    const ScoredKnots all = united_knots(solver, criterion, scored(knots), loss);
    return std::set<double>(all.knots.begin(), all.knots.end()).size();
  };
  EXPECT_EQ(places({0.4999, 0.5, 0.5, 0.5, 0.5}, 1e9), 2U);
  EXPECT_EQ(places({0.4953, 0.5062}, 1e9), 2U);  // two data between
  EXPECT_EQ(places({0.3001, 0.3002, 0.3048, 0.3049}, -1e9), 4U);
}

}  // namespace
}  // namespace keyline::fit::detail
