#include "keyline/fairing/bound.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

/// Sides of lines that a curve stays on.
namespace keyline::fairing {
namespace {

using core::HalfPlane;
using core::Point2;

TEST(Bound, IsReadFromText) {
  const auto low = Bound::from_text("x>=2.5");
  ASSERT_TRUE(low);
  EXPECT_EQ(*low, (Bound{Axis::x, 2.5, {}}));
  const auto high = Bound::from_text("y<=-1");
  ASSERT_TRUE(high);
  EXPECT_EQ(*high, (Bound{Axis::y, {}, -1}));
  for (const char* text : {"", "x", "x>=", "z>=1", "x=>1", "x==1", "x>1", "x>=one", "xx>=1"})
    EXPECT_FALSE(Bound::from_text(text)) << text;
  EXPECT_TRUE(Bound::from_text("x>=1"));  // the shortest there is
}

TEST(Bound, LimitsSomethingAndLeavesSomething) {
  const auto blamed = [](const Bound& bound) {
    const auto sound = Bound::check(bound);
    return sound ? std::string() : sound.error().path;
  };
  EXPECT_EQ(blamed({Axis::x, {}, {}}), "at_least");
  EXPECT_EQ(blamed({Axis::x, 1, {}}), "");
  EXPECT_EQ(blamed({Axis::x, {}, 1}), "");
  EXPECT_EQ(blamed({Axis::x, 0, 1}), "");
  EXPECT_EQ(blamed({Axis::x, 1, 1}), "at_most");
  EXPECT_EQ(blamed({Axis::x, 2, 1}), "at_most");
}

TEST(Bound, HalfPlanesHoldWhatTheBoundsDo) {
  const std::vector<Bound> bounds{{Axis::x, 1, 3}, {Axis::y, {}, -2}};
  const auto halves = half_planes(bounds);
  ASSERT_EQ(halves.size(), 3U);
  for (const Point2 p :
       {Point2{1.5, -4}, Point2{2.5, -2.5}, Point2{0.5, -3}, Point2{4, -3}, Point2{2, -1}}) {
    EXPECT_DOUBLE_EQ(core::depth(halves[0], p), p.x - 1);
    EXPECT_DOUBLE_EQ(core::depth(halves[1], p), 3 - p.x);
    EXPECT_DOUBLE_EQ(core::depth(halves[2], p), -2 - p.y);
  }
}

}  // namespace

namespace detail {
namespace {

const HalfPlane kAbove{{0, 1}, 0};  // y >= 0

std::vector<FitPoint> level(const std::vector<double>& xs, double y) {
  std::vector<FitPoint> points;
  for (const double x : xs) points.push_back({.position = {x, y}});
  return points;
}

// Five between neighbours at sixths of their gap, where a border is nearer than the gap is wide and
// the gap wider than the tolerance; each counts as much as the tolerance is of the gap.
TEST(WithWatchers, StandWhereABorderIsNear) {
  const auto points = level({0, 0.1, 0.4, 0.5}, 0.2);
  const std::vector<HalfPlane> inside{kAbove};
  const auto watched = with_watchers(points, true, inside, 0.01);
  // Gaps of 0.1 are narrower than the border is far, 0.3 and the closing 0.5 are not.
  ASSERT_EQ(watched.size(), 4U + 10);
  for (int i = 1; i <= 5; ++i) {
    EXPECT_NEAR(watched[1 + i].position.x, 0.1 + 0.05 * i, 1e-12);
    EXPECT_NEAR(watched[1 + i].share, 0.01 / 0.3, 1e-12);
    EXPECT_EQ(watched[1 + i].count, 0);
    EXPECT_NEAR(watched[8 + i].position.x, 0.5 - 0.5 * i / 6, 1e-12);
  }
  EXPECT_EQ(with_watchers(points, true, inside, 0.31).size(), 4U + 5);  // only the widest gap
  EXPECT_EQ(with_watchers(points, true, {}, 0.01).size(), 4U);
  const std::vector<HalfPlane> far{{{0, 1}, -0.4}};
  EXPECT_EQ(with_watchers(points, true, far, 0.01).size(), 4U);
}

// Beside the ends of an open curve three more, at 0.001, 0.01 and 0.05 of the way.
TEST(WithWatchers, AreMoreBesideOpenEnds) {
  const auto points = level({0, 1, 2, 3}, 0.2);
  const auto watched = with_watchers(points, false, std::vector{kAbove}, 0.01);
  ASSERT_EQ(watched.size(), 4U + 15 + 6);
  const std::vector<double> near{0.001, 0.01, 0.05};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(watched[1 + i].position.x, near[i], 1e-12);
    EXPECT_NEAR(watched[watched.size() - 2 - i].position.x, 3 - near[i], 1e-12);
  }
  EXPECT_EQ(watched.back().position, (Point2{3, 0.2}));
}

// A curve to the right has its normal upwards: y >= 0 leaves a point at 0.2 offsets up to 0.2 (the
// point lies left of the curve then), a curve to the left down to -0.2.
TEST(LimitOffsets, LeaveTheCurveInside) {
  auto points = level({0, 1, 2, 3}, 0.2);
  points[2].share = 0.5;
  const std::vector<double> margin{0.05};
  limit_offsets(points, false, std::vector{kAbove}, margin, {});
  for (const std::size_t j : {0U, 1U, 3U}) {
    EXPECT_NEAR(points[j].highest, 0.2 - 0.05, 1e-15) << j;
    EXPECT_EQ(points[j].lowest, -HUGE_VAL);
  }
  EXPECT_NEAR(points[2].highest, 0.5 * 0.15, 1e-15);
  auto back = level({3, 2, 1, 0}, 0.2);
  limit_offsets(back, false, std::vector{kAbove}, margin, {});
  EXPECT_NEAR(back[1].lowest, -0.15, 1e-15);
  EXPECT_EQ(back[1].highest, HUGE_VAL);
}

// Of two borders the nearer one counts; one that the curve stands square to does not.
TEST(LimitOffsets, AreOfTheNearestBorderThatRunsAlong) {
  auto points = level({0, 1, 2, 3}, 0.2);
  const std::vector<HalfPlane> inside{kAbove, {{0, 1}, 0.1}, {{1, 0}, -9}, {{0, -1}, -0.5}};
  const std::vector<double> margin(4, 0);
  limit_offsets(points, false, inside, margin, {});
  EXPECT_NEAR(points[1].highest, 0.1, 1e-15);
  EXPECT_NEAR(points[1].lowest, -0.3, 1e-15);
  // Across a border at an angle the way to it is longer.
  auto leaning = level({0, 1, 2, 3}, 0.2);
  const double angle = std::numbers::pi / 3;
  const HalfPlane slanted{{std::sin(angle), std::cos(angle)}, -1};
  limit_offsets(leaning, false, std::vector{slanted}, std::vector{0.0}, {});
  const double depth = std::sin(angle) * 1 + std::cos(angle) * 0.2 + 1;
  EXPECT_NEAR(leaning[1].highest, depth / std::cos(angle), 1e-14);
}

TEST(LimitOffsets, OfClosedCurvesNormalsGoRound) {
  // A square run to the left: the normal of a corner is along the diagonal, inwards.
  std::vector<FitPoint> points;
  for (const Point2 p : {Point2{0, 0}, Point2{1, 0}, Point2{1, 1}, Point2{0, 1}})
    points.push_back({.position = p});
  const HalfPlane right_of{{1, 0}, -0.3};
  limit_offsets(points, true, std::vector{right_of}, std::vector{0.0}, {});
  const double root = std::numbers::sqrt2;
  EXPECT_NEAR(points[0].highest, 0.3 * root, 1e-14);  // normal (1, 1) / sqrt 2
  EXPECT_NEAR(points[1].lowest, -1.3 * root, 1e-14);
  EXPECT_NEAR(points[2].lowest, -1.3 * root, 1e-14);
  EXPECT_NEAR(points[3].highest, 0.3 * root, 1e-14);
}

// No margin where an end is held, half the way to it beside it, no limit at the end itself.
TEST(LimitOffsets, GiveWayBesideHeldEnds) {
  auto points = level({0, 0.1, 1, 2}, 0.2);
  const std::vector<Point2> held{{0, 0.2}};
  limit_offsets(points, false, std::vector{kAbove}, std::vector{0.12}, held);
  EXPECT_EQ(points[0].highest, HUGE_VAL);
  EXPECT_NEAR(points[1].highest, 0.2 - 0.05, 1e-15);
  EXPECT_NEAR(points[2].highest, 0.2 - 0.12, 1e-15);
  EXPECT_NEAR(points[3].highest, 0.2 - 0.12, 1e-15);
}

// By no more than the tolerance, and to the border alone; inner points stay where they were
// measured.
TEST(DrawEndsInside, EndsThatLieOutsideStandOnTheBorder) {
  const std::vector<HalfPlane> inside{{{0, 1}, 0.5}, {{-1, 0}, -3}};
  std::vector<FitPoint> points(4);
  points[0].position = {0, 0.45};
  points[1].position = {1, 0.44};
  points[2].position = {2, 0.9};
  points[3].position = {3.06, 0.42};
  draw_ends_inside(points, inside, 0.07);
  EXPECT_EQ(points[0].position, (Point2{0, 0.5}));
  EXPECT_EQ(points[1].position, (Point2{1, 0.44}));
  EXPECT_EQ(points[2].position, (Point2{2, 0.9}));
  EXPECT_NEAR(points[3].position.x, 3, 1e-15);
  EXPECT_NEAR(points[3].position.y, 0.42, 1e-15);  // 0.08 outside: too far to be an error
}

// A circle of radius 1 about (0, 1) dips by exactly its radius' rest below y = 0.25.
TEST(Outside, IsHowFarAnArcDips) {
  const double pi = std::numbers::pi;
  const lac::Chain circle{{{1, 1}, pi / 2}, {{-1, 2 * pi, 1, 1}}, true};
  EXPECT_NEAR(outside(circle, {{0, 1}, 0.25}), 0.25, 1e-12);
  EXPECT_EQ(outside(circle, {{0, 1}, -0.25}), 0);
  EXPECT_NEAR(outside(circle, {{1, 0}, 0.5}), 1.5, 1e-12);
  EXPECT_NEAR(outside(circle, {{0, -1}, -1.9}), 0.1, 1e-12);
}

// A line of length 2 that ends a hair outside stands on the border; farther out it does not.
TEST(Outside, IsNoMatterOfRounding) {
  const lac::Chain line{{{0, 1}, -std::numbers::pi / 2}, {{-1, 2, 0, 0}}, false};
  EXPECT_EQ(outside(line, {{0, 1}, -1 + 1e-12}), 0);
  EXPECT_NEAR(outside(line, {{0, 1}, -1 + 1e-11}), 1e-11, 1e-14);
}

// Lowest at an end, where no place inside is.
TEST(Outside, CountsEndsToo) {
  const lac::Chain line{{{0, 1}, -0.5}, {{-1, 4, 0, 0}}, false};
  EXPECT_NEAR(outside(line, kAbove), 4 * std::sin(0.5) - 1, 1e-12);
  EXPECT_NEAR(outside(line, {{1, 0}, 0.5}), 0.5, 1e-12);
}

}  // namespace
}  // namespace detail
}  // namespace keyline::fairing
