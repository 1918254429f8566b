#include "keyline/sketch/segments.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/curve/jet.h"
#include "keyline/sketch/quintics.h"

namespace keyline::sketch {
namespace {

using core::Point2;

std::vector<Point2> arc(double radius, double from, double to) {
  std::vector<Point2> points;
  const int n = static_cast<int>(radius * (to - from));
  for (int i = 0; i <= n; ++i) {
    const double a = from + (to - from) * i / n;
    points.push_back({radius * std::cos(a), radius * std::sin(a)});
  }
  return points;
}

TEST(Segments, GroupsFollowSturgesRuleOnStraightLines) {
  std::vector<Point2> line;
  for (int i = 0; i < 160; ++i) line.push_back({1.0 * i, 0.5 * i});
  const auto runs = fit_segments(line, false, {});
  ASSERT_EQ(runs.size(), 1U);
  // the paper's 8 groups of 20 points: 1 + log2 160 = 8.3, taken upwards
  EXPECT_EQ(runs[0].axes.size(), 9U);
  for (const Point2 p : runs[0].vertices) EXPECT_NEAR(p.y, 0.5 * p.x, 1e-9);
  EXPECT_NEAR(core::distance(runs[0].vertices.front(), line.front()), 0, 1e-9);
  EXPECT_NEAR(core::distance(runs[0].vertices.back(), line.back()), 0, 1e-9);
}

TEST(Segments, AreRefinedUntilStraight) {
  const auto points = arc(60, 0, 3);
  for (const double tolerance : {2.0, 0.5, 0.1}) {
    const auto runs = fit_segments(points, false, {.straightness = tolerance});
    ASSERT_EQ(runs.size(), 1U);
    for (const Axis& axis : runs[0].axes) EXPECT_LE(axis.largest_offset, tolerance);
    for (const Point2 v : runs[0].vertices) EXPECT_NEAR(std::hypot(v.x, v.y), 60, 4 * tolerance);
  }
}

TEST(Segments, CornersAreFoundAndMeetExactly) {
  std::vector<Point2> ell;
  for (int i = 0; i <= 80; ++i) ell.push_back({80.0 - i, 0});
  for (int i = 1; i <= 80; ++i) ell.push_back({0, 1.0 * i});
  const auto runs = fit_segments(ell, false, {});
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].vertices.back(), runs[1].vertices.front());
  EXPECT_LT(core::distance(runs[0].vertices.back(), {0, 0}), 0.5);
  EXPECT_TRUE(find_corners(arc(30, 0, 5), false, {}).empty()) << "a tight arc is no corner";
}

TEST(Quintics, KeepTheQuadraticsAndBecomeG2) {
  const auto runs = fit_segments(arc(50, 0, 6.0), false, {});
  const auto quadratic = quadratics(runs[0].vertices, false);
  auto quintic = elevated(quadratic);
  ASSERT_EQ(quintic.size(), quadratic.size());
  for (std::size_t i = 0; i < quintic.size(); ++i)
    for (const double t : {0.0, 0.25, 0.7, 1.0})
      EXPECT_LT(core::distance(evaluate(quintic[i], t), evaluate(quadratic[i], t)), 1e-12);
  make_curvature_continuous(quintic, false);
  for (std::size_t i = 0; i + 1 < quintic.size(); ++i) {
    EXPECT_NEAR(end_curvature(quintic[i]), start_curvature(quintic[i + 1]), 1e-12);
    EXPECT_NEAR(curvature(jet(quintic[i], 1)), end_curvature(quintic[i]), 1e-12);    // Eq. 10
    EXPECT_NEAR(curvature(jet(quintic[i], 0)), start_curvature(quintic[i]), 1e-12);  // Eq. 9
    EXPECT_NEAR(tangent_angle(jet(quintic[i], 1)), tangent_angle(jet(quintic[i + 1], 0)), 1e-9);
  }
}

}  // namespace
}  // namespace keyline::sketch
