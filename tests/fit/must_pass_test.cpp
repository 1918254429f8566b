#include "keyline/fit/must_pass.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/fit/fit_spline.h"

namespace keyline::fit {
namespace {

SplineFitOptions passing(std::vector<std::size_t> points, int order = 4) {
  SplineFitOptions options;
  options.order = order;
  options.trials = 2;
  options.generations = 30;
  options.must_pass = std::move(points);
  return options;
}

std::vector<std::size_t> up_to(std::size_t count) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(i);
  return all;
}

// The criterion forbids as many knots as interpolation takes; every point was missed by 0.66, and
// nothing told it.
TEST(MustPass, AllPointsAreInterpolated) {
  const std::vector<core::Point2> points{{0, 0}, {1, 1}, {2, 0}, {3, 1}, {4, 0}, {5, 2}, {6, 1}};
  for (const int order : {3, 4, 5}) {
    const auto fit = fit_spline(points, {}, passing(up_to(points.size()), order));
    ASSERT_TRUE(fit) << order << ' ' << fit.error().message;
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_LT(core::distance(evaluate(fit->curve, fit->parameters[i]), points[i]), 1e-8)
          << order << ' ' << i;
    EXPECT_TRUE(std::isfinite(fit->bic));
  }
}

// A closed spline is found by way of an open one, which has fewer knots than the data.
TEST(MustPass, AClosedCurvePassesSomeOfThemAndSaysWhereItCannotPassAll) {
  std::vector<core::Point2> ring;
  for (int i = 0; i < 14; ++i) {
    const double angle = i * core::kPi / 7, radius = i % 2 == 0 ? 2 : 1.2;
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  SplineFitOptions options = passing({2, 3, 4, 5});
  options.closed = true;
  const auto some = fit_spline(ring, {}, options);
  ASSERT_TRUE(some) << some.error().message;
  for (const std::size_t i : options.must_pass)
    EXPECT_LT(core::distance(evaluate(some->curve, some->parameters[i]), ring[i]), 1e-3) << i;
  options.must_pass = up_to(14);
  const auto all = fit_spline(ring, {}, options);
  ASSERT_FALSE(all);
  EXPECT_EQ(all.error().code, core::ErrorCode::not_converged);
}

TEST(MustPass, AllValuesOfAFunctionAreInterpolated) {
  std::vector<double> x, y;
  for (int i = 0; i < 9; ++i) {
    x.push_back(i);
    y.push_back(i % 2 == 0 ? 1 : -1);
  }
  const auto fit = fit_function(x, y, {}, passing(up_to(9)));
  ASSERT_TRUE(fit) << fit.error().message;
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(evaluate(fit->spline, x[i], 0), y[i], 1e-8);
  EXPECT_TRUE(std::isfinite(fit->bic));
}

// Five neighbours far off a line of thirty: fewer coefficients lie there than have to serve.
TEST(MustPass, NeighboursAreAllPassed) {
  std::vector<core::Point2> points;
  for (int i = 0; i < 30; ++i)
    points.push_back({double(i), 0.05 * std::sin(9.7 * i) + (i > 11 && i < 17 && i % 2 ? 1 : 0)});
  const auto fit = fit_spline(points, {}, passing({12, 13, 14, 15, 16}));
  ASSERT_TRUE(fit) << fit.error().message;
  for (const std::size_t i : {12, 13, 14, 15, 16})
    EXPECT_LT(core::distance(evaluate(fit->curve, fit->parameters[i]), points[i]), 1e-3);
}

TEST(MustPass, WhatCannotBePassedIsNamed) {
  const std::vector<double> x{0, 1, 2, 2, 3, 4, 5}, y{0, 1, 0, 3, 1, 0, 1};
  const auto fit = fit_function(x, y, {}, passing({2, 3}));
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().code, core::ErrorCode::not_converged);
  EXPECT_EQ(fit.error().path, "must_pass");
  EXPECT_NE(fit.error().message.find("is missed by 1.5"), std::string::npos) << fit.error().message;
}

// What is told of a fit goes by the weights given, not by those that hold the points. Nor do these
// raise the floor that the rounding of the data sets to the squares, which left no knot to find.
TEST(MustPass, PointsCountAsOthersInWhatIsTold) {
  std::vector<core::Point2> points;
  std::vector<double> x, y;
  for (int i = 0; i < 60; ++i) {
    x.push_back(i / 6.0);
    y.push_back(std::round(100 * std::sin(x.back()) + 3 * std::cos(37 * i)) / 100);
    points.push_back({x.back(), y.back()});
  }
  std::vector<double> uneven(60, 1.0);
  uneven[7] = 3;
  for (const std::vector<double>& weights : {std::vector<double>(60, 1.0), uneven}) {
    const auto curve = fit_spline(points, weights, passing({30}));
    const auto function = fit_function(x, y, weights, passing({30}));
    ASSERT_TRUE(curve && function);
    double sum = 0, squares = 0, of_function = 0;
    for (std::size_t i = 0; i < 60; ++i) {
      const double d = distance(evaluate(curve->curve, curve->parameters[i]), points[i]);
      sum += weights[i];
      squares += weights[i] * d * d;
      of_function += weights[i] * std::pow(evaluate(function->spline, x[i], 0) - y[i], 2);
    }
    EXPECT_NEAR(curve->sse, squares, 1e-9);
    EXPECT_NEAR(curve->rms, std::sqrt(squares / sum), 1e-9);
    EXPECT_NEAR(function->sse, of_function, 1e-9);
    EXPECT_NEAR(function->rms, std::sqrt(of_function / sum), 1e-9);
    EXPECT_LT(curve->rms, 0.03 / std::sqrt(2));  // of what the cosine adds
    EXPECT_LT(function->rms, 0.03 / std::sqrt(2));
  }
}

}  // namespace
}  // namespace keyline::fit
