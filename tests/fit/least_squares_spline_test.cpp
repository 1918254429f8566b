#include "keyline/fit/least_squares_spline.h"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "keyline/numeric/random.h"

namespace keyline::fit {
namespace {

using numeric::Random;

SplineData random_data(int count, int columns, bool weighted, std::uint64_t seed) {
  Random random(seed);
  SplineData data;
  data.columns.resize(static_cast<std::size_t>(columns));
  double t = 0;
  for (int i = 0; i < count; ++i) {
    data.parameters.push_back(t);
    for (auto& column : data.columns) column.push_back(random.normal());
    if (weighted) data.weights.push_back(random.uniform(0.1, 3));
    t += random.uniform(0.1, 1);
  }
  return data;
}

/// The same fit by a dense QR on B-splines evaluated as splines of unit coefficients.
double dense_sum_of_squares(const SplineData& data, const LeastSquaresSpline& spline) {
  const auto n = static_cast<Eigen::Index>(data.parameters.size());
  const auto m = static_cast<Eigen::Index>(spline.coefficients[0].size());
  Eigen::MatrixXd a(n, m);
  LeastSquaresSpline unit = spline;
  for (Eigen::Index j = 0; j < m; ++j) {
    unit.coefficients = {std::vector<double>(static_cast<std::size_t>(m), 0.0)};
    unit.coefficients[0][static_cast<std::size_t>(j)] = 1;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double w = data.weights.empty() ? 1 : std::sqrt(data.weights[at]);
      a(i, j) = w * evaluate(unit, data.parameters[at]);
    }
  }
  double sum = 0;
  for (const auto& column : data.columns) {
    Eigen::VectorXd b(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      b[i] = column[at] * (data.weights.empty() ? 1 : std::sqrt(data.weights[at]));
    }
    sum += (a * a.householderQr().solve(b) - b).squaredNorm();
  }
  return sum;
}

TEST(LeastSquaresSpline, AgreesWithADenseSolver) {
  for (int order = 2; order <= 8; ++order) {
    for (const bool weighted : {false, true}) {
      for (const int columns : {1, 2, 3}) {
        const SplineData data = random_data(60, columns, weighted, 11);
        const double end = data.parameters.back();
        const std::vector<double> knots = {0.2 * end, 0.21 * end, 0.5 * end, 0.5 * end, 0.9 * end};
        const auto fit = least_squares_spline(data, knots, order);
        ASSERT_TRUE(fit) << order;
        const double dense = dense_sum_of_squares(data, *fit);
        EXPECT_NEAR(fit->sum_of_squares, dense, 1e-12 * dense) << order << ' ' << columns;
      }
    }
  }
}

TEST(LeastSquaresSpline, SumWithoutSolvingIsTheSame) {
  const SplineData data = random_data(100, 2, true, 5);
  SplineSolver solver(data, {0, data.parameters.back()}, 4);
  const std::vector<double> knots = {5, 9, 9, 20, 30.5};
  const double sum = solver.sum_of_squares(knots);
  ASSERT_TRUE(solver.solve(knots));
  std::vector<double> residuals(200);
  solver.residuals(residuals);
  double squares = 0;
  for (const double r : residuals) squares += r * r;
  EXPECT_NEAR(sum, squares, 1e-13 * sum);
}

/// A piecewise cubic with a kink at 0.3 and a jump at 0.6.
double broken(double x) {
  if (x < 0.3) return 1 + x - 4 * x * x * x;
  if (x < 0.6) return 1 + 0.3 - 4 * 0.027 + 3 * (x - 0.3) * (x - 0.5);
  return -1 + x * x;
}

TEST(LeastSquaresSpline, TripleKnotsMakeKinksAndFourfoldOnesJumps) {
  SplineData data{{}, {{}}, {}};
  for (int i = 0; i <= 100; ++i) {
    data.parameters.push_back(i / 100.0);
    data.columns[0].push_back(broken(i / 100.0));
  }
  const auto exact = least_squares_spline(data, {0.3, 0.3, 0.3, 0.6, 0.6, 0.6, 0.6}, 4);
  ASSERT_TRUE(exact);
  EXPECT_LT(exact->sum_of_squares, 1e-26);
  EXPECT_NEAR(evaluate(*exact, 0.6), broken(0.6), 1e-13);  // continuous from the right
  EXPECT_NEAR(evaluate(*exact, 0.6 - 1e-12), broken(0.6 - 1e-12), 1e-9);
  const auto smooth = least_squares_spline(data, {0.3, 0.3, 0.6, 0.6}, 4);
  ASSERT_TRUE(smooth);
  EXPECT_GT(smooth->sum_of_squares, 1e-3);
}

TEST(LeastSquaresSpline, DeficientKnotsHaveNoFit) {
  SplineData data = random_data(30, 1, false, 1);
  SplineSolver solver(data, {0, data.parameters.back()}, 4);
  const double a = data.parameters[10];
  const double b = data.parameters[11];
  const auto crowd = [&](int count) {
    std::vector<double> knots;
    for (int i = 1; i <= count; ++i) knots.push_back(a + (b - a) * i / (count + 1));
    return knots;
  };
  EXPECT_TRUE(std::isfinite(solver.sum_of_squares(crowd(3))));
  EXPECT_TRUE(std::isinf(solver.sum_of_squares(crowd(5))));  // a B-spline without data
  EXPECT_TRUE(std::isinf(solver.sum_of_squares(std::vector<double>(5, (a + b) / 2))));
  EXPECT_TRUE(std::isinf(solver.sum_of_squares(std::vector<double>{3, 2})));
  EXPECT_TRUE(std::isinf(solver.sum_of_squares(std::vector<double>{0.0})));
  EXPECT_TRUE(std::isinf(solver.sum_of_squares(std::vector<double>{std::nan("")})));
  EXPECT_TRUE(std::isfinite(solver.sum_of_squares(crowd(2))));  // and the solver is as before
  const auto failed = least_squares_spline(data, crowd(5), 4);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, core::ErrorCode::not_converged);
}

TEST(LeastSquaresSpline, RepeatedParametersAreData) {
  const SplineData data{{0, 0, 1, 1, 2, 2, 3, 3}, {{0, 2, 1, 3, 2, 4, 3, 5}}, {}};
  const auto fit = least_squares_spline(data, {}, 4);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->sum_of_squares, 8, 1e-12);
  EXPECT_NEAR(evaluate(*fit, 1.5), 2.5, 1e-12);
}

TEST(LeastSquaresSpline, WeightsPull) {
  SplineData data{{0, 1, 2, 3, 4, 5}, {{0, 0, 1, 0, 0, 0}}, {1, 1, 1e8, 1, 1, 1}};
  const auto fit = least_squares_spline(data, {}, 2);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(evaluate(*fit, 2), 1, 1e-6);
}

TEST(LeastSquaresSpline, BadInputIsRefused) {
  const double nan = std::nan("");
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<SplineData> bad = {
      {{}, {}, {}},
      {{0, 1, 2, 3}, {}, {}},
      {{0, 1, nan, 3}, {{0, 0, 0, 0}}, {}},
      {{0, 1, 2, 3}, {{0, inf, 0, 0}}, {}},
      {{0, 2, 1, 3}, {{0, 0, 0, 0}}, {}},
      {{0, 1, 2, 3}, {{0, 0, 0}}, {}},
      {{0, 1, 2, 3}, {{0, 0, 0, 0}}, {1, 1, 1}},
      {{0, 1, 2, 3}, {{0, 0, 0, 0}}, {1, 1, 0, 1}},
      {{1, 1, 1, 1}, {{0, 0, 0, 0}}, {}},
  };
  for (const SplineData& data : bad) {
    const auto fit = least_squares_spline(data, {}, 4);
    ASSERT_FALSE(fit);
    EXPECT_EQ(fit.error().code, core::ErrorCode::bad_input);
  }
  const SplineData good{{0, 1, 2, 3}, {{0, 0, 0, 0}}, {}};
  EXPECT_FALSE(least_squares_spline(good, {5}, 4));
  EXPECT_FALSE(least_squares_spline(good, {}, 1));
  EXPECT_FALSE(least_squares_spline(good, {}, 9));
  EXPECT_TRUE(least_squares_spline(good, {}, 4));
  EXPECT_THROW(SplineSolver(bad[2], {0, 3}, 4), core::InvalidInput);
  EXPECT_THROW(SplineSolver(good, {0, 2}, 4), core::InvalidInput);
}

// Two data delta apart in the last span decide two coefficients: the part of the last column that
// the one before does not hold is 2 delta / (|c1| |c2|) = 4 delta of its length. The limit is 1e-7.
// In the first span it is the second column's.
TEST(SplineSolver, RankIsJudgedAgainstTheColumn) {
  for (const bool first : {false, true}) {
    const auto fitted = [first](double delta) {
      SplineData data;
      data.parameters = {0, 0.75, 0.75 + delta};
      if (first) data.parameters = {0.25 - delta, 0.25, 1};
      data.columns = {{1, 2, 3}};
      SplineSolver solver(data, {0, 1}, 2);
      const double knots[] = {0.5};
      return std::isfinite(solver.sum_of_squares(knots));
    };
    EXPECT_TRUE(fitted(1e-3));
    EXPECT_TRUE(fitted(4e-8));
    EXPECT_FALSE(fitted(1.5e-8));
    EXPECT_FALSE(fitted(0));
  }
}

/// A solver goes on from where its last knots and the new ones part: that must not show.
TEST(LeastSquaresSpline, KnotsAfterOtherKnotsGiveTheSameBits) {
  SplineData data{{}, {{}, {}}, {}};
  for (int i = 0; i <= 300; ++i) {
    const double t = i / 300.0;
    data.parameters.push_back(t);
    data.columns[0].push_back(std::sin(9 * t));
    data.columns[1].push_back(std::exp(-t) + 1e-3 * std::cos(7.0 * i));
  }
  const std::vector<std::vector<double>> rows = {{0.2, 0.4, 0.6, 0.8},
                                                 {0.2, 0.4, 0.61, 0.8},
                                                 {0.2, 0.4, 0.61, 0.8, 0.9},
                                                 {0.2, 0.4, 0.61, 0.61001},
                                                 {0.2, 0.4},
                                                 {0.2, 0.4, 0.4, 0.4, 0.7},
                                                 {0.2, 0.4, 0.4, 0.7},
                                                 {0.2, 0.4, 0.6, 0.8, 0.95},
                                                 {0.1, 0.4, 0.6, 0.8, 0.95}};
  SplineSolver one(data, {0, 1}, 5);
  std::vector<double> after(602);
  std::vector<double> alone(602);
  for (const auto& knots : rows) {
    SplineSolver fresh(data, {0, 1}, 5);
    const bool found = fresh.solve(knots);
    ASSERT_EQ(one.solve(knots), found);
    EXPECT_EQ(one.sum_of_squares(knots), fresh.sum_of_squares(knots));
    if (!found) continue;
    one.residuals(after);
    fresh.residuals(alone);
    EXPECT_EQ(after, alone);
  }
}

}  // namespace
}  // namespace keyline::fit
