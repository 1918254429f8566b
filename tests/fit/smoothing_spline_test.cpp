#include "keyline/fit/smoothing_spline.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::fit {
namespace {

std::vector<core::Point2> ellipse(int n, double share, double noise) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> unit(0, 1);
  const auto error = [&](std::mt19937_64& from) { return noise * unit(from); };
  std::vector<core::Point2> points;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * share * i / (share < 1 ? n - 1 : n);
    points.push_back({3 * std::cos(t) + error(random), 2 * std::sin(t) + error(random)});
  }
  return points;
}

double largest(const curve::CurvatureGraph& graph) {
  double most = 0;
  for (const double k : graph.curvature) most = std::max(most, std::abs(k));
  return most;
}

double own_variation(const curve::CurvatureGraph& g) {
  double sum = 0;
  for (std::size_t i = 1; i < g.arc_length.size(); ++i)
    sum +=
        std::pow(g.curvature[i] - g.curvature[i - 1], 2) / (g.arc_length[i] - g.arc_length[i - 1]);
  return sum;
}

TEST(SmoothingSpline, HasTheCurvatureOfAnEllipse) {
  const auto graph = smoothing_spline_curvature(ellipse(400, 1, 0), true, 1e-5);
  ASSERT_TRUE(graph);
  EXPECT_NEAR(graph->arc_length.back(), 15.8654396, 1e-3);  // perimeter, Ramanujan's series
  EXPECT_NEAR(largest(*graph), 0.75, 1e-2);                 // a / b^2
}

TEST(SmoothingSpline, IsSmootherTheWiderTheTolerance) {
  const auto points = ellipse(300, 0.6, 1e-3);
  double last = HUGE_VAL;
  for (const double tolerance : {3e-3, 2e-2}) {
    const auto graph = smoothing_spline_curvature(points, false, tolerance);
    ASSERT_TRUE(graph) << tolerance;
    const double energy = own_variation(*graph);
    EXPECT_LT(energy, last) << tolerance;
    last = energy;
  }
}

/// A nose whose curvature is 75 times that of its length: points are dense there, and knots that
/// are even along the chords have none to spare for it.
TEST(SmoothingSpline, FollowsATightNose) {
  std::vector<core::Point2> points;
  for (int i = 0; i <= 32; ++i) {
    const double t = std::numbers::pi * (i / 16.0 - 1) / 2;
    points.push_back({3 * std::cos(t), 0.2 * std::sin(t)});
  }
  const auto graph = smoothing_spline_curvature(points, false, 1e-4);
  ASSERT_TRUE(graph);
  EXPECT_NEAR(largest(*graph), 75, 5);  // a / b^2
}

// A quarter of the unit circle: three points say little more than that it is bent.
TEST(SmoothingSpline, OfFewPointsIsBentAsTheyAre) {
  for (const int n : {3, 4, 5, 7}) {
    std::vector<core::Point2> points;
    for (int i = 0; i < n; ++i) {
      const double t = std::numbers::pi / 2 * i / (n - 1);
      points.push_back({std::cos(t), std::sin(t)});
    }
    const auto graph = smoothing_spline_curvature(points, false, 1e-4);
    ASSERT_TRUE(graph) << n;
    EXPECT_NEAR(graph->arc_length.back(), std::numbers::pi / 2, n < 5 ? 0.03 : 1e-3) << n;
    EXPECT_NEAR(largest(*graph), 1, n < 5 ? 0.6 : 0.1) << n;
  }
}

TEST(SmoothingSpline, RefusesWhatHasNone) {
  const std::vector<core::Point2> one(20, {1, 2});
  EXPECT_FALSE(smoothing_spline_curvature(one, false, 1e-3));
  EXPECT_FALSE(smoothing_spline_curvature(std::vector<core::Point2>{{0, 0}, {1, 1}}, false, 1e-3));
}

}  // namespace
}  // namespace keyline::fit
