#include "keyline/fit/final_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace keyline::fit::detail {
namespace {

/// Two columns over [0, 1] that no spline meets.
SplineData noisy(std::size_t n, bool weighted) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0, 1);
  SplineData data;
  data.columns.resize(2);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(n);
    data.parameters.push_back(t);
    data.columns[0].push_back(std::cos(2 * M_PI * t) + 0.1 * any(random));
    data.columns[1].push_back(std::sin(2 * M_PI * t) + 0.1 * any(random));
    if (weighted) data.weights.push_back(0.5 + any(random));
  }
  return data;
}

TEST(Misfit, IsWhatTheValuesLeave) {
  for (const bool weighted : {false, true}) {
    const SplineData data = noisy(50, weighted);
    const auto spline = final_fit(data, {0, 1}, {0.3, 0.6}, 4);
    ASSERT_TRUE(spline);
    double sum = 0, weights = 0, largest = 0;
    for (std::size_t i = 0; i < 50; ++i) {
      const double w = weighted ? data.weights[i] : 1;
      const double dx = evaluate(*spline, data.parameters[i], 0) - data.columns[0][i];
      const double dy = evaluate(*spline, data.parameters[i], 1) - data.columns[1][i];
      sum += w * (dx * dx + dy * dy);
      weights += w;
      largest = std::max(largest, std::hypot(dx, dy));
    }
    EXPECT_NEAR(sum_of_weights(data), weights, 1e-13);
    const Misfit m = misfit(*spline, data);
    EXPECT_NEAR(m.sse, sum, 1e-13);
    EXPECT_NEAR(m.rms, std::sqrt(sum / weights), 1e-13);
    EXPECT_NEAR(m.largest, largest, 1e-13);
  }
}

// The gradient of the squares vanishes: no other coefficient would leave less.
TEST(FinalFit, NoOtherCoefficientLeavesLess) {
  for (const bool weighted : {false, true}) {
    const SplineData data = noisy(50, weighted);
    auto spline = final_fit(data, {0, 1}, {0.3, 0.6, 0.6, 0.8}, 4);
    ASSERT_TRUE(spline);
    EXPECT_EQ(interior_of(*spline), (std::vector<double>{0.3, 0.6, 0.6, 0.8}));
    const double least = misfit(*spline, data).sse;
    for (auto& column : spline->coefficients) {
      ASSERT_EQ(column.size(), 8u);
      for (double& c : column)
        for (const double by : {-1e-3, 1e-3}) {
          const double kept = c;
          c += by;
          EXPECT_GT(misfit(*spline, data).sse, least);
          c = kept;
        }
    }
  }
}

TEST(FinalFit, OfKnotsThatAreTooCloseLeavesOneOut) {
  SplineData data;
  data.columns.resize(1);
  for (int i = 0; i <= 20; ++i) {
    data.parameters.push_back(i / 20.0);
    data.columns[0].push_back(std::cos(i));
  }
  // No datum lies between 0.51 and 0.54: five knots there leave a basis function without one.
  const auto spline = final_fit(data, {0, 1}, {0.2, 0.511, 0.516, 0.52, 0.5305, 0.54, 0.8}, 4);
  ASSERT_TRUE(spline);
  EXPECT_EQ(interior_of(*spline), (std::vector<double>{0.2, 0.511, 0.516, 0.5305, 0.54, 0.8}));
  EXPECT_FALSE(final_fit({{0, 1}, {{1, 2}}, {}}, {0, 1}, {0.5}, 4));
}

/// Value and derivatives of one column from the right of 0 and the left of 1, by differences of
/// the polynomials there.
std::array<double, 3> jet_at(const LeastSquaresSpline& s, double t, double way,
                             std::size_t column) {
  constexpr double h = 1e-3;
  std::array<double, 4> v;
  for (int i = 0; i < 4; ++i) v[i] = evaluate(s, t + way * h * i, column);
  // Exact for cubics: one-sided differences of four values.
  return {v[0], way * (-11 * v[0] + 18 * v[1] - 9 * v[2] + 2 * v[3]) / (6 * h),
          (2 * v[0] - 5 * v[1] + 4 * v[2] - v[3]) / (h * h)};
}

TEST(ClosedFit, GoesOnOverItsEndAsOverItsKnots) {
  for (const std::vector<double>& knots :
       {std::vector<double>{0, 0.2, 0.45, 0.7, 0.9}, {0.1, 0.3, 0.31, 0.6, 0.8}, {0.5}, {}}) {
    SCOPED_TRACE(knots.size());
    const auto spline = closed_fit(noisy(60, true), knots, 4);
    ASSERT_TRUE(spline);
    EXPECT_EQ(spline->knots.front(), 0);
    EXPECT_EQ(spline->knots.back(), 1);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto start = jet_at(*spline, 0, 1, k);
      const auto end = jet_at(*spline, 1, -1, k);
      EXPECT_NEAR(start[0], end[0], 1e-12);
      EXPECT_NEAR(start[1], end[1], 1e-8);
      EXPECT_NEAR(start[2], end[2], 1e-6);
    }
  }
}

/// Cubic B-spline over the four spans of five knots, by its divided difference.
double b_spline(const std::array<double, 5>& t, double x) {
  double sum = 0;
  for (int i = 0; i < 5; ++i) {
    double product = 1;
    for (int j = 0; j < 5; ++j)
      if (j != i) product *= t[i] - t[j];
    sum += std::pow(std::max(0.0, t[i] - x), 3) / product;
  }
  return (t[4] - t[0]) * sum;
}

// What is left is at right angles to every periodic B-spline of the knots: no periodic spline of
// them leaves less. The first point counts once, half at either end.
TEST(ClosedFit, NoPeriodicSplineOfTheKnotsLeavesLess) {
  for (const std::vector<double>& knots :
       {std::vector<double>{0, 0.2, 0.45, 0.7, 0.9}, {0.1, 0.3, 0.42, 0.6, 0.8}})
    for (const bool weighted : {false, true}) {
      const SplineData data = noisy(60, weighted);
      const auto spline = closed_fit(data, knots, 4);
      ASSERT_TRUE(spline);
      const std::size_t n = knots.size();
      for (std::size_t first = 0; first < n; ++first) {
        std::array<double, 5> t;
        for (std::size_t j = 0; j < 5; ++j)
          t[j] = knots[(first + j) % n] + static_cast<double>((first + j) / n);
        for (std::size_t k = 0; k < 2; ++k) {
          double sum = 0;
          for (std::size_t i = 0; i < data.parameters.size(); ++i) {
            const double x = data.parameters[i];
            const double basis = b_spline(t, x) + b_spline(t, x + 1) + b_spline(t, x + 2);
            const double left = evaluate(*spline, x, k) - data.columns[k][i];
            sum += (weighted ? data.weights[i] : 1) * basis * left;
          }
          EXPECT_NEAR(sum, 0, 1e-10);
        }
      }
    }
}

TEST(ClosedFit, HasThreeKnotsAtLeastInTheWidestGaps) {
  const SplineData data = noisy(60, false);
  EXPECT_EQ(interior_of(*closed_fit(data, {}, 4)),
            (std::vector<double>{0.25, 0.5}));  // 0 is an end
  EXPECT_EQ(interior_of(*closed_fit(data, {0.5}, 4)), (std::vector<double>{0.25, 0.5}));
  const auto behind = interior_of(*closed_fit(data, {0.2, 0.3}, 4));
  ASSERT_EQ(behind.size(), 3u);
  EXPECT_NEAR(behind[2], 0.75, 1e-15);
  const auto over_the_end = interior_of(*closed_fit(data, {0.6, 0.8}, 4));
  ASSERT_EQ(over_the_end.size(), 3u);
  EXPECT_NEAR(over_the_end[0], 0.2, 1e-15);
}

}  // namespace
}  // namespace keyline::fit::detail
