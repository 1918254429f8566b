#include "keyline/fairing/mirror.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

/// Mirror symmetry of points.
namespace keyline::fairing {
namespace {

using core::Point2;

TEST(Mirror, ImagesInALine) {
  const core::Pose2 line{{1, 2}, std::numbers::pi / 4};  // y = x + 1
  const Point2 image = mirrored(line, {5, 1});
  EXPECT_NEAR(image.x, 0, 1e-14);
  EXPECT_NEAR(image.y, 6, 1e-14);
  EXPECT_NEAR(beside(line, {5, 1}), -5 / std::numbers::sqrt2, 1e-14);
  EXPECT_NEAR(beside(line, image), 5 / std::numbers::sqrt2, 1e-14);
  EXPECT_NEAR(beside(line, {7, 8}), 0, 1e-14);
}

/// A pear about a line through (2, 1) at an angle, which no other line halves.
std::vector<Point2> pear(double angle, int n, double from) {
  std::vector<Point2> points;
  for (int i = 0; i < n; ++i) {
    const double t = from + 2 * std::numbers::pi * i / n;
    const double r = 3 + std::cos(t) + 0.3 * std::cos(2 * t);
    points.push_back({2 + r * std::cos(t + angle), 1 + r * std::sin(t + angle)});
  }
  return points;
}

TEST(Mirror, LineOfAPearIsItsAxis) {
  for (const double angle : {0.0, 0.7, 2.5})
    for (const double from : {0.0, 0.03}) {
      const auto found = best_mirror(pear(angle, 120, from), true);
      ASSERT_TRUE(found);
      EXPECT_NEAR(std::sin(found->line.direction - angle), 0, 1e-5) << angle;
      EXPECT_NEAR(beside({{2, 1}, angle}, found->line.position), 0, 1e-4) << angle;
      EXPECT_LT(found->rms, 1e-4);
      EXPECT_LE(found->rms, found->largest);
      EXPECT_LT(found->largest, 1e-3);
    }
}

// A closed line has no beginning: feet are sought over the seam.
TEST(Mirror, ClosedLinesMayBeginAnywhere) {
  auto points = pear(0.7, 24, 0.004);  // images fall beside points
  const auto first = best_mirror(points, true);
  ASSERT_TRUE(first);
  for (int k = 0; k < 24; ++k) {
    std::rotate(points.begin(), points.begin() + 1, points.end());
    const auto found = best_mirror(points, true);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->rms, first->rms, 1e-3 * first->rms) << k;
    EXPECT_NEAR(found->largest, first->largest, 1e-2 * first->largest) << k;
  }
}

// Pushed out at one side alone, the mean square tells by how much.
TEST(Mirror, MisfitIsWhatTheSidesDifferBy) {
  auto points = pear(0, 200, 0);
  for (Point2& p : points)
    if (p.y > 1) p.y += 0.01 * std::sin((p.y - 1) / 3);
  const auto found = best_mirror(points, true);
  ASSERT_TRUE(found);
  EXPECT_GT(found->rms, 5e-4);
  EXPECT_LT(found->rms, 1e-2);
  EXPECT_GT(found->largest, found->rms);
}

TEST(Mirror, OpenLinesChangeEnds) {
  std::vector<Point2> arch;
  for (int i = 0; i <= 50; ++i) {
    const double x = 0.02 * i - 0.5;
    arch.push_back({x, 1 - x * x});
  }
  const auto found = best_mirror(arch, false);
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::abs(std::sin(found->line.direction)), 1, 1e-9);
  EXPECT_NEAR(found->line.position.x, 0, 1e-9);
  EXPECT_LT(found->largest, 1e-6);
}

TEST(Mirror, SixPointsAreTheFewest) {
  std::vector<Point2> hexagon;
  for (int i = 0; i < 6; ++i)
    hexagon.push_back({std::cos(core::kPi / 3 * i), std::sin(core::kPi / 3 * i)});
  EXPECT_TRUE(best_mirror(hexagon, true));
  hexagon.pop_back();
  EXPECT_FALSE(best_mirror(hexagon, true));
}

// In that very line: moved by d from the axis every image moves by 2 d across.
TEST(Mirror, MeasuredInALineThatIsNotTheAxis) {
  std::vector<Point2> circle;
  for (int i = 0; i < 360; ++i) {
    const double t = core::kPi / 180 * i;
    circle.push_back({std::cos(t), std::sin(t)});
  }
  const double d = 0.003;
  const Mirror off = measured_in({{0, d}, 0}, circle, true);
  EXPECT_NEAR(off.largest, 2 * d, 2e-5);
  EXPECT_NEAR(off.rms, 2 * d / std::numbers::sqrt2, 2e-5);  // sin^2 has the mean 1/2
  EXPECT_EQ(off.line.position.y, d);
  const Mirror on = measured_in({{0, 0}, 1}, circle, true);
  EXPECT_LT(on.largest, 1e-4);
  std::vector<Point2> level;
  for (int i = 0; i <= 20; ++i) level.push_back({0.1 * i, 0});
  const Mirror open = measured_in({{1, 0}, core::kPi / 2}, level, false);
  EXPECT_LT(open.largest, 1e-12);
}

// A parabola mirrored beside its axis by d: the image of (x, x^2) lies 4 d x above or below the
// curve, across it by that over sqrt(1 + 4 x^2). Its largest is at the ends, its mean square
// 4 (1 - atan(2) / 2) d^2 on [-1, 1].
TEST(Mirror, MisfitOfAParabolaIsKnown) {
  std::vector<Point2> points;
  for (int i = 0; i <= 400; ++i) {
    const double x = i / 200.0 - 1;
    points.push_back({x, x * x});
  }
  for (const double d : {1e-3, -2e-3}) {
    const Mirror found = measured_in({{d, 5}, core::kPi / 2}, points, false);
    EXPECT_NEAR(found.largest, 4 / std::sqrt(5.0) * std::abs(d), 0.01 * std::abs(d));
    EXPECT_NEAR(found.rms, 2 * std::sqrt(1 - std::atan(2.0) / 2) * std::abs(d), 0.01 * std::abs(d));
  }
  EXPECT_LT(measured_in({{0, 5}, core::kPi / 2}, points, false).largest, 1e-9);
}

// Of more than 500 points too, whose curve has fewer vertices a gap.
TEST(Mirror, ManyPointsHaveTheirAxis) {
  const auto found = best_mirror(pear(0.7, 1500, 0.001), true);
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::sin(found->line.direction - 0.7), 0, 1e-5);
  EXPECT_NEAR(beside({{2, 1}, 0.7}, found->line.position), 0, 1e-4);
  EXPECT_LT(found->largest, 1e-4);
}

// A side that zigzags is longer by a factor of sqrt(1.09): shares of the length tell where images
// belong to within twenty edges, and from there they are found.
TEST(Mirror, SidesMayDifferInLength) {
  std::vector<Point2> points;
  for (int i = -1000; i <= 1000; ++i) points.push_back({double(i), i < 0 && i % 2 != 0 ? 0.3 : 0});
  const Mirror found = measured_in({{0, 0}, core::kPi / 2}, points, false);
  EXPECT_NEAR(found.largest, 0.3, 1e-9);
}

}  // namespace
}  // namespace keyline::fairing
