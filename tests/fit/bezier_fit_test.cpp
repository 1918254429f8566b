#include "keyline/fit/bezier_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/closest_point.h"

namespace keyline::fit {
namespace {

using core::Point2;
using core::Vector2;

std::vector<Point2> arc(double angle, int count) {
  std::vector<Point2> points;
  for (int i = 0; i < count; ++i) {
    const double a = angle * i / (count - 1);
    points.push_back({std::sin(a), 1 - std::cos(a)});
  }
  return points;
}

TEST(BezierFit, FindsTheCurveItCameFrom) {
  const curve::Bezier2 truth{{{0, 0}, {1, 2}, {3, 3}, {5, 2}, {6, -1}}, {}};
  BezierFitOptions options;
  options.tolerance = 1e-5;
  const auto fit = fit_bezier(truth, options);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->within);
  EXPECT_LE(curve::degree(fit->curve), 4);
  EXPECT_LE(fit->deviation, 1e-5);
}

TEST(BezierFit, DegreeGrowsAsTheToleranceShrinks) {
  const auto points = arc(2.5, 100);
  int last = 3;
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    BezierFitOptions options;
    options.tolerance = tolerance;
    const auto fit = fit_bezier(points, {1, 0}, core::unit_vector(2.5), options);
    ASSERT_TRUE(fit);
    EXPECT_TRUE(fit->within) << tolerance;
    EXPECT_GE(curve::degree(fit->curve), last);
    last = curve::degree(fit->curve);
  }
  EXPECT_GT(last, 3);
  EXPECT_LE(last, 6);
}

TEST(BezierFit, EndsAndTangentsAreKept) {
  const auto points = arc(1.2, 30);
  const auto fit = fit_bezier(points, {2, 0}, 3 * core::unit_vector(1.2));
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->curve.control.front(), points.front());
  EXPECT_EQ(fit->curve.control.back(), points.back());
  EXPECT_NEAR(core::direction_of(jet(fit->curve, 0.0).first), 0, 1e-12);
  EXPECT_NEAR(core::direction_of(jet(fit->curve, 1.0).first), 1.2, 1e-12);
}

TEST(BezierFit, MissedToleranceIsReported) {
  std::vector<Point2> zigzag;
  for (int i = 0; i <= 40; ++i) zigzag.push_back({0.1 * i, i % 2 * 0.5});
  const auto fit = fit_bezier(zigzag, {1, 0}, {1, 0});
  ASSERT_TRUE(fit);
  EXPECT_FALSE(fit->within);
  EXPECT_GT(fit->deviation, 0.1);
  EXPECT_LT(fit->deviation, 1);
}

TEST(BezierFit, BadInputIsRefused) {
  EXPECT_FALSE(fit_bezier(std::vector<Point2>{}, Vector2{1, 0}, {1, 0}));
  EXPECT_FALSE(fit_bezier(std::vector<Point2>(3, Point2{1, 1}), Vector2{1, 0}, {1, 0}));
  EXPECT_FALSE(fit_bezier(arc(1, 10), Vector2{0, 0}, {1, 0}));
  EXPECT_FALSE(fit_bezier(arc(1, 10), Vector2{1, 0}, {std::nan(""), 0}));
  auto points = arc(1, 10);
  points[3].x = INFINITY;
  EXPECT_FALSE(fit_bezier(points, Vector2{1, 0}, {1, 0}));
  BezierFitOptions options;
  options.lowest_degree = 2;
  EXPECT_FALSE(fit_bezier(arc(1, 10), Vector2{1, 0}, {1, 0}, options));
  EXPECT_TRUE(fit_bezier(arc(0.5, 2), Vector2{1, 0}, core::unit_vector(0.5)));
}

// Without a round of reparametrisation the curve is that of the samples' chord lengths.
TEST(BezierFit, NoRoundsOfReparametrisationLeaveACurve) {
  const auto points = arc(1.2, 30);
  BezierFitOptions options;
  options.iterations = 0;
  const auto fit = fit_bezier(points, {1, 0}, core::unit_vector(1.2), options);
  ASSERT_TRUE(fit);
  ASSERT_GE(fit->curve.control.size(), 4U);
  EXPECT_EQ(fit->curve.control.front(), points.front());
  EXPECT_LT(fit->deviation, 1e-2);
}

/// At the least sum of squared distances the offsets of the samples, weighed by the Bernstein
/// polynomial of a control point that is free, add up to nothing.
TEST(BezierFit, NoFreeControlPointWouldComeNearer) {
  std::vector<Point2> points;  // e^(0.4 a): the speed of a fit grows fivefold
  for (int i = 0; i <= 200; ++i) {
    const double a = 4.0 * i / 200;
    points.push_back({std::exp(0.4 * a) * std::cos(a), std::exp(0.4 * a) * std::sin(a)});
  }
  const Vector2 start{0.4, 1}, end = core::rotate_ccw(Vector2{0.4, 1}, 4.0);
  BezierFitOptions options;
  options.tolerance = 1e-9;
  options.lowest_degree = options.highest_degree = 5;
  const auto fit = fit_bezier(points, start, end, options);
  ASSERT_TRUE(fit);
  for (const int j : {2, 3}) {
    Vector2 sum{};
    double size = 0;
    for (const Point2 p : points) {
      const double t = curve::closest_point(fit->curve, p).t;
      const double b = 10 * std::pow(t, j) * std::pow(1 - t, 5 - j);
      const Vector2 off = p - evaluate(fit->curve, t);
      sum = sum + b * off;
      size += b * core::norm(off);
    }
    EXPECT_LT(core::norm(sum), 1e-4 * size) << j;
  }
}

/// Largest distance of points from a curve, by its points at small steps.
double measured(const std::vector<Point2>& points, const curve::Bezier2& c) {
  double most = 0;
  for (const Point2 p : points) {
    double least = HUGE_VAL;
    for (int i = 0; i <= 20000; ++i)
      least = std::min(least, core::distance(p, evaluate(c, i / 20000.0)));
    most = std::max(most, least);
  }
  return most;
}

TEST(BezierFit, DeviationIsTheLargestDistance) {
  const auto circle = arc(2.5, 60);
  for (const double tolerance : {1e-1, 1e-2}) {
    BezierFitOptions options;
    options.tolerance = tolerance;
    const auto fit = fit_bezier(circle, {1, 0}, core::unit_vector(2.5), options);
    ASSERT_TRUE(fit);
    const double most = measured(circle, fit->curve);
    EXPECT_NEAR(fit->deviation, most, 0.02 * most);
  }
}

}  // namespace
}  // namespace keyline::fit
