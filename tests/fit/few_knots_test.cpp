#include "keyline/fit/few_knots.h"

#include <algorithm>
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
  std::vector<core::Point2> points;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * share * i / (share < 1 ? n - 1 : n);
    const double x = noise * unit(random);
    points.push_back({3 * std::cos(t) + x, 2 * std::sin(t) + noise * unit(random)});
  }
  return points;
}

TEST(FewKnots, HaveTheCurvatureOfAnEllipse) {
  const auto graph = few_knots_curvature(ellipse(200, 1, 0), true, 1e-5);
  ASSERT_TRUE(graph);
  double largest = 0;
  for (const double k : graph->curvature) largest = std::max(largest, std::abs(k));
  EXPECT_NEAR(graph->arc_length.back(), 15.8654396, 1e-3);  // perimeter, Ramanujan's series
  EXPECT_NEAR(largest, 0.75, 1e-2);                         // a / b^2
}

// Points that come twice and a seam that is there twice change nothing.
TEST(FewKnots, TakeEveryPointOnce) {
  const auto points = ellipse(40, 1, 1e-3);
  std::vector<core::Point2> twice;
  for (const core::Point2 p : points) twice.insert(twice.end(), 2, p);
  twice.push_back(points.front());
  const auto once = few_knots_curvature(points, true, 4e-3);
  const auto again = few_knots_curvature(twice, true, 4e-3);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->curvature, again->curvature);
}

// As tight as rounding, where there have to be as many knots as points allow.
TEST(FewKnots, KeepATightTolerance) {
  EXPECT_TRUE(few_knots_curvature(ellipse(30, 0.6, 1e-2), false, 1e-9));
  EXPECT_TRUE(few_knots_curvature(ellipse(30, 1, 1e-2), true, 1e-9));
}

TEST(FewKnots, AreOfEightPointsOrMore) {
  auto points = ellipse(8, 0.5, 0);
  EXPECT_TRUE(few_knots_curvature(points, false, 1e-2));
  points[4] = points[3];
  EXPECT_FALSE(few_knots_curvature(points, false, 1e-2));
}

// As many knots as it takes: here more than a hundred.
TEST(FewKnots, MayBeMany) {
  EXPECT_TRUE(few_knots_curvature(ellipse(150, 0.9, 1e-2), false, 1e-7));
}

std::vector<core::Point2> lobes(int n, double radius, int count, double height) {
  std::vector<core::Point2> points;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    const double r = radius + height * std::cos(count * t);
    points.push_back({r * std::cos(t), r * std::sin(t)});
  }
  return points;
}

// The largest penalty that keeps the tolerance draws a circle in, by all of it at the worst place.
TEST(FewKnots, UseUpTheTolerance) {
  for (const double tolerance : {0.3, 1e-2, 1e-5}) {
    const auto graph = few_knots_curvature(lobes(120, 3, 0, 0), true, tolerance);
    ASSERT_TRUE(graph);
    const double drawn_in = 3 - graph->arc_length.back() / (2 * std::numbers::pi);
    EXPECT_LT(drawn_in, tolerance);
    EXPECT_GT(drawn_in, 0.4 * tolerance);
  }
}

// Waves that are alike get knots alike: of k lobes of height a on a radius r curvature swings by
// 2 a (k^2 - 1) / r^2, and hardly by more.
TEST(FewKnots, AreWhereOffsetsAreLargest) {
  const auto graph = few_knots_curvature(lobes(900, 3, 30, 0.01), true, 5e-3);
  ASSERT_TRUE(graph);
  const auto [low, high] = std::ranges::minmax(graph->curvature);
  EXPECT_LT(high - low, 1.03 * 2 * 0.01 * 899 / 9);
}

// Chords of a zigzag are longer than the way along: what counts is how near the curve passes, not
// where it is at that share of the chords.
TEST(FewKnots, DistanceIsThatFromTheNearestPlace) {
  constexpr double d = 0.01;
  std::vector<core::Point2> points;
  for (int i = 0; i < 240; ++i) {
    const double angle = 2 * std::numbers::pi * i / 240;
    const double r = 3 + (i < 120 ? 0 : i % 2 == 1 ? d : -d);
    points.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  const auto graph = few_knots_curvature(points, false, 1.2 * d);
  ASSERT_TRUE(graph);
  for (const double k : graph->curvature) EXPECT_NEAR(k, 1.0 / 3, 0.05);
}

TEST(FewKnots, RefuseWhatHasNone) {
  const std::vector<core::Point2> one(20, {1, 2});
  EXPECT_FALSE(few_knots_curvature(one, false, 1e-3));
  EXPECT_FALSE(few_knots_curvature(ellipse(5, 1, 0), false, 1e-3));
}

}  // namespace
}  // namespace keyline::fit
