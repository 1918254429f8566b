#include "keyline/fairing/half_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

/// Symmetric lines folded and unfolded.
namespace keyline::fairing::detail {
namespace {

using core::Point2;

const core::Pose2 kAxis{{0, 0}, 0};  // the x axis

/// An ellipse about the x axis, whose points are each other's images or half a step off.
acquire::KeyLine ellipse(int n, double offset) {
  acquire::KeyLine line;
  line.closed = true;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * (i + offset) / n;
    line.points.push_back({2 * std::cos(t), std::sin(t)});
  }
  line.noise = 0.1;
  line.rounding = 0.01;
  return line;
}

// Images that stand beside own points make one of two, and half as much noise as root two.
TEST(Fold, PairsBecomeTheirMeans) {
  const acquire::KeyLine line = ellipse(40, 0.5);
  const auto half = fold(line, kAxis);
  ASSERT_TRUE(half);
  EXPECT_EQ(half->line.points.size(), 20U);
  EXPECT_EQ(half->measured.size(), 40U);
  EXPECT_EQ(half->start, HalfEnd::square);
  EXPECT_EQ(half->end, HalfEnd::square);
  EXPECT_NEAR(half->line.noise, 0.1 / std::numbers::sqrt2, 1e-15);
  EXPECT_EQ(half->line.rounding, 0.01);
  double before = 3;
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(half->line.weights[i], 2);
    EXPECT_LT(std::abs(half->line.points[i].y - line.points[20 + i].y) *
                  std::abs(half->line.points[i].y - line.points[i].y),
              1e-12);
    EXPECT_NE(half->line.points[i].x, before);
    before = half->line.points[i].x;
  }
  for (std::size_t k = 0; k < 40; ++k)
    EXPECT_LT(core::distance(half->measured[k], half->line.points[half->belongs[k]]), 1e-12);
}

// Half a step off every image stands between two own points: none are paired.
TEST(Fold, WhatStandsBetweenStaysByItself) {
  const auto half = fold(ellipse(40, 0.25), kAxis);
  ASSERT_TRUE(half);
  EXPECT_EQ(half->line.points.size(), 40U);
  EXPECT_NEAR(half->line.noise, 0.1, 1e-15);
  const auto& p = half->line.points;
  const bool falls = p.front().x > p.back().x;
  for (std::size_t i = 1; i < p.size(); ++i) EXPECT_EQ(p[i - 1].x > p[i].x, falls) << i;
  for (const Point2 q : p) EXPECT_EQ(q.y > 0, p[20].y > 0);
}

// One side is longer by a zigzag, so that equal shares of both sides' lengths are no images of each
// other: beside it all points of the half stand in the order of the curve.
TEST(Fold, ImagesStandWhereTheirFeetAre) {
  acquire::KeyLine line;
  line.closed = true;
  const double pi = std::numbers::pi;
  const auto add = [&](double t, double r) {
    line.points.push_back({2 * r * std::cos(t), r * std::sin(t)});
  };
  for (int i = 0; i < 100; ++i) add(pi * (i + 0.5) / 100, 1);
  for (int i = 0; i < 60; ++i) {
    const double t = pi * (1 + (i + 0.4) / 60);
    add(t, std::abs(std::cos(t)) < 0.5 ? 1 + (i % 2 == 0 ? 0.03 : -0.03) : 1);
  }
  const auto half = fold(line, kAxis);
  ASSERT_TRUE(half);
  EXPECT_EQ(half->measured.size(), 160U);
  const auto& p = half->line.points;
  const bool falls = p.front().x > p.back().x;
  int beside = 0;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (std::abs(p[i].x) < 1.2 || std::abs(p[i - 1].x) < 1.2) continue;
    ++beside;
    EXPECT_EQ(p[i - 1].x > p[i].x, falls) << i;
  }
  EXPECT_GT(beside, 50);
}

TEST(Fold, LinesThatDoNotCrossAsTheyShouldAreRefused) {
  EXPECT_FALSE(fold(ellipse(40, 0.5), {{0, 3}, 0}));     // not at all
  EXPECT_FALSE(fold(ellipse(40, 0.5), {{0, 0.99}, 0}));  // hardly anything on one side
  acquire::KeyLine wave;
  for (int i = 0; i <= 60; ++i) wave.points.push_back({0.1 * i, std::sin(0.16 * i - 0.8)});
  EXPECT_FALSE(fold(wave, kAxis));  // open: two or three times
}

// An open arch about the y axis: it ends off the line and crosses it square.
TEST(Fold, OpenLinesCrossOnce) {
  acquire::KeyLine arch;
  for (int i = 0; i < 21; ++i) {
    const double x = 0.1 * i - 1.0;
    arch.points.push_back({x, 1 - x * x});
  }
  arch.weights.assign(21, 2);
  const auto half = fold(arch, {{0, 0}, std::numbers::pi / 2});
  ASSERT_TRUE(half);
  EXPECT_EQ(half->start, HalfEnd::free);
  EXPECT_EQ(half->end, HalfEnd::square);
  // Ten pairs and the one on the line.
  EXPECT_EQ(half->measured.size(), 21U);
  EXPECT_EQ(half->line.points.size(), 11U);
  EXPECT_EQ(half->line.weights[0], 4);
  EXPECT_EQ(half->line.weights[3], 4);
  // A free end whose image stands elsewhere stays two.
  arch.points.front() = arch.points.front() + core::Vector2{0.001, 0.003};
  const auto longer = fold(arch, {{0, 0}, std::numbers::pi / 2});
  ASSERT_TRUE(longer);
  EXPECT_EQ(longer->line.points.size(), 12U);
  EXPECT_EQ(longer->line.weights[0], 2);
}

// Corners have partners on the other side, or stand on the line.
TEST(Fold, CornersComeInPairs) {
  acquire::KeyLine line;  // a house: corners below and at the eaves, the ridge on the y axis
  line.closed = true;
  const auto side = [&](Point2 a, Point2 b) {
    for (int i = 0; i < 10; ++i) line.points.push_back(core::mix(a, b, i / 10.0));
  };
  side({-1, 0}, {1, 0});
  side({1, 0}, {1, 1});
  side({1, 1}, {0, 2});
  side({0, 2}, {-1, 1});
  side({-1, 1}, {-1, 0});
  const core::Pose2 axis{{0, 0}, std::numbers::pi / 2};
  line.corners = {0, 10, 20, 30, 40};
  const auto half = fold(line, axis);
  ASSERT_TRUE(half);
  EXPECT_EQ(half->line.corners.size(), 2U);
  for (const std::size_t c : half->line.corners)
    EXPECT_NEAR(std::abs(half->line.points[c].x), 1, 1e-9);
  const bool ridge_first = half->line.points.front().y > 1;
  EXPECT_EQ(ridge_first ? half->start : half->end, HalfEnd::corner);
  EXPECT_EQ(ridge_first ? half->end : half->start, HalfEnd::square);
  line.corners = {0, 20, 30, 40};
  const auto lone = fold(line, axis);
  ASSERT_FALSE(lone);
  EXPECT_NE(lone.error().message.find("(-1, 0)"), std::string::npos);
}

lac::Chain quarter() {
  return {{{1, 0}, std::numbers::pi / 2},
          {{-1, std::numbers::pi / 4, 1, 1}, {-1, std::numbers::pi / 4, 1, 1}},
          false};
}

// Half a circle and its image are one closed chain whose arcs go on across the line.
TEST(Unfold, ArcsThatCrossTheLineStayOne) {
  lac::Chain half = quarter();
  half.pieces.push_back({-1, std::numbers::pi / 2, 1, 1});
  HalfLine folded;
  folded.start = folded.end = HalfEnd::square;
  const auto all = unfold({half}, folded, kAxis, true);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_TRUE(all[0].closed);
  EXPECT_NEAR(lac::arc_length(all[0]), 2 * std::numbers::pi, 1e-14);
  EXPECT_EQ(all[0].pieces.size(), 5U);  // 3 and 3, joined in one place
  const core::Pose2 end = lac::end_pose(all[0]);
  EXPECT_NEAR(core::distance(end.position, {1, 0}), 0, 1e-14);
}

// Curves that are no arcs stay two.
TEST(Unfold, CurvesMeetOnTheLine) {
  lac::Chain half{{{0, 0}, 0.5}, {{-1, 1, 0.2, -0.5}}, false};
  // Ends square on its own axis.
  const core::Pose2 end = lac::end_pose(half);
  const core::Pose2 axis{end.position, end.direction + std::numbers::pi / 2};
  const auto all = unfold({half}, {}, axis, false);
  ASSERT_EQ(all.size(), 1U);
  ASSERT_EQ(all[0].pieces.size(), 2U);
  EXPECT_FALSE(all[0].closed);
  EXPECT_NEAR(all[0].pieces[1].curvature_start, -0.5, 1e-15);
  EXPECT_NEAR(all[0].pieces[1].curvature_end, 0.2, 1e-15);
}

TEST(Unfold, CornersOnTheLineEndChains) {
  HalfLine folded;
  folded.end = HalfEnd::corner;
  folded.start = HalfEnd::corner;
  const auto all = unfold({quarter()}, folded, kAxis, true);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_FALSE(all[0].closed);
  EXPECT_NEAR(core::distance(lac::end_pose(all[1]).position, {1, 0}), 0, 1e-14);
  EXPECT_NEAR(core::distance(all[1].start.position, {0, -1}), 0, 1e-14);
}

// Square at its start only: the last chain, an image, goes on into the first.
TEST(Unfold, TheSeamOfAClosedOneIsJoinedAtItsStart) {
  HalfLine folded;
  folded.start = HalfEnd::square;
  folded.end = HalfEnd::corner;
  const auto all = unfold({quarter()}, folded, kAxis, true);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_FALSE(all[0].closed);
  EXPECT_EQ(all[0].pieces.size(), 3U);
  EXPECT_NEAR(all[0].pieces[1].length, std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(core::distance(all[0].start.position, {0, -1}), 0, 1e-14);
}

// Of a pair the heavier one counts as often as it weighs.
TEST(Fold, PairsAreWeightedMeans) {
  acquire::KeyLine line = ellipse(40, 0.5);
  for (Point2& p : line.points) {
    const bool above = p.y > 0;
    line.weights.push_back(above ? 1 : 3);
    if (above) p = {1.001 * p.x, 1.001 * p.y};
  }
  const auto half = fold(line, kAxis);
  ASSERT_TRUE(half);
  ASSERT_EQ(half->line.points.size(), 20U);
  std::vector<Point2> found = half->line.points;
  std::ranges::sort(found, {}, [](Point2 p) { return -p.x; });
  for (int i = 0; i < 20; ++i) {
    const double t = 2 * std::numbers::pi * (i + 0.5) / 40;
    EXPECT_NEAR(found[i].x, 2 * std::cos(t) * (1.001 + 3) / 4, 1e-12) << i;
    EXPECT_NEAR(std::abs(found[i].y), std::sin(t) * (1.001 + 3) / 4, 1e-12) << i;
    EXPECT_EQ(half->line.weights[i], 4);
  }
}

// Side by side is within three tenths of the points' spacing: here a step of 9 degrees of a circle
// turned by so much of it that images stand twice that beside points.
TEST(Fold, SideBySideIsThreeTenthsOfTheSpacing) {
  const auto count = [](double turned) {
    acquire::KeyLine circle;
    circle.closed = true;
    for (int i = 0; i < 40; ++i) {
      const double t = 2 * std::numbers::pi * (i + 0.5 + turned) / 40;
      circle.points.push_back({std::cos(t), std::sin(t)});
    }
    return fold(circle, kAxis)->line.points.size();
  };
  EXPECT_EQ(count(0.13), 20U);
  EXPECT_GT(count(0.17), 37U);
}

}  // namespace
}  // namespace keyline::fairing::detail
