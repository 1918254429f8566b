#include "keyline/sketch/segments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/jet.h"
#include "keyline/sketch/quintics.h"
#include "keyline/sketch/trace.h"

#include "page.h"

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

// The ink of both arms is one up to two pens from the tip of a sharp corner: the line went round
// there, up to 7 pixels before the tip. It comes to within a pixel of it.
TEST(Segments, SharpCornersOfThickPensReachTheirTips) {
  for (const auto& [degrees, width] : {std::pair{33.0, 8.0}, {40.0, 6.0}, {55.0, 9.0}, {90.0, 5.0}})
    for (const double axis : {0.2, 2.5}) {
      SCOPED_TRACE(std::to_string(degrees) + " degrees along " + std::to_string(axis));
      const Point2 tip{100 - 40 * std::cos(axis), 100 - 40 * std::sin(axis)};
      Image page = testing::blank_page(200, 200);
      for (const double side : {-0.5, 0.5}) {
        const double along = axis + side * degrees * std::numbers::pi / 180;
        testing::draw_line(page, tip, tip + 90 * core::unit_vector(along), width);
      }
      const auto result = trace(page);
      ASSERT_TRUE(result) << result.error().message;
      double nearest = HUGE_VAL;
      for (const Stroke& stroke : result->strokes)
        for (const curve::Bezier2& piece : stroke.curve)
          for (const double t : {0.0, 1.0}) {
            const Point2 p = evaluate(piece, t);
            nearest = std::min(nearest, core::distance({p.x, 200 - p.y}, tip));
          }
      EXPECT_LT(nearest, 1);
    }
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
