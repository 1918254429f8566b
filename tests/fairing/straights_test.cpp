#include "keyline/fairing/straights.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

/// Lines put into a curve, by which nodes they take.
namespace keyline::fairing::detail {
namespace {

/// Ten cells of curvature 1, 2, …, 11.
DenseCurve ten() {
  DenseCurve curve;
  for (int i = 0; i <= 10; ++i) {
    curve.at.push_back(0.1 * i);
    curve.joints.push_back({{1.0 * i, 0}, 0, 1.0 + i});
  }
  set_free(curve);
  curve.sense.assign(10, 1);
  return curve;
}

TEST(WithLines, ALineTakesItsNodesAndLeavesAShareOfIt) {
  const DenseCurve out = with_lines(ten(), {{2, 8}}, 0.2);
  // Of a length of 0.6 a fifth, 0.12, at either end: from node 4 to node 6.
  EXPECT_EQ(out.cut, (std::vector<int>{0, 1, 2, 3, 4, 6, 7, 8, 9, 10}));
  EXPECT_EQ(out.kind[4], PieceKind::line);
  EXPECT_EQ(out.kind[3], PieceKind::curve);
  EXPECT_EQ(out.value, (std::vector<double>{1, 2, 3, 4, 0, 0, 8, 9, 10, 11}));
  EXPECT_EQ(out.alpha, std::vector<double>(9, -1));
  ASSERT_EQ(out.sense.size(), 9U);
  EXPECT_EQ(out.sense[4], 0);
  EXPECT_EQ(out.sense[5], 1);
  const DenseCurve whole = with_lines(ten(), {{2, 8}}, 0);
  EXPECT_EQ(whole.cut, (std::vector<int>{0, 1, 2, 8, 9, 10}));
}

// Beside a line curvature keeps to its side as before; the line itself has none.
TEST(WithLines, SidesStayBesideThem) {
  DenseCurve curve = ten();
  curve.side.assign(11, 1);
  curve.side[8] = 0;
  const DenseCurve out = with_lines(curve, {{2, 8}}, 0.2);  // from node 4 to node 6
  EXPECT_EQ(out.side, (std::vector<signed char>{1, 1, 1, 1, 0, 0, 1, 0, 1, 1}));
}

TEST(WithLines, AtASeamBothEndsHaveNoSide) {
  DenseCurve curve = ten();
  curve.closed = true;
  curve.side.assign(11, 1);
  const DenseCurve out = with_lines(curve, {{0, 5}}, 0);
  EXPECT_EQ(out.side.front(), 0);
  EXPECT_EQ(out.side.back(), 0);
}

// An open curve's own ends stay where they are; a closed one's are as any other.
TEST(WithLines, EndsOfAnOpenCurveAreNotShortened) {
  const DenseCurve out = with_lines(ten(), {{0, 5}}, 0.2);
  EXPECT_EQ(out.cut, (std::vector<int>{0, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(out.value[0], 0);
  const DenseCurve last = with_lines(ten(), {{5, 10}}, 0.2);
  EXPECT_EQ(last.cut, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 10}));
  EXPECT_EQ(last.value.back(), 0);
  // A line that ends one node before the curve does is shortened: of 0.7 by 0.14 either way.
  EXPECT_EQ(with_lines(ten(), {{2, 9}}, 0.2).cut, (std::vector<int>{0, 1, 2, 3, 4, 7, 8, 9, 10}));
  EXPECT_EQ(with_lines(ten(), {{1, 8}}, 0.2).cut, (std::vector<int>{0, 1, 2, 3, 6, 7, 8, 9, 10}));
  DenseCurve closed = ten();
  closed.closed = true;
  const DenseCurve round = with_lines(closed, {{0, 5}}, 0.2);
  EXPECT_EQ(round.cut, (std::vector<int>{0, 1, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(round.value.front(), 1);
  const DenseCurve seam = with_lines(closed, {{0, 5}}, 0);
  EXPECT_EQ(seam.value.front(), 0);
  EXPECT_EQ(seam.value.back(), 0);
  const DenseCurve other_side = with_lines(closed, {{5, 10}}, 0);
  EXPECT_EQ(other_side.value.front(), 0);
  EXPECT_EQ(other_side.value.back(), 0);
}

// However large the share, two cells are left of a line.
TEST(WithLines, KeepTwoCells) {
  EXPECT_EQ(with_lines(ten(), {{2, 5}}, 0.4).cut,
            (std::vector<int>{0, 1, 2, 3, 5, 6, 7, 8, 9, 10}));
}

TEST(WithLines, SeveralAndNone) {
  const DenseCurve out = with_lines(ten(), {{1, 3}, {6, 9}}, 0);
  EXPECT_EQ(out.cut, (std::vector<int>{0, 1, 3, 4, 5, 6, 9, 10}));
  EXPECT_EQ(out.value, (std::vector<double>{1, 0, 0, 5, 6, 0, 0, 11}));
  const DenseCurve none = with_lines(ten(), {}, 0.1);
  EXPECT_EQ(none.cut.size(), 11U);
  DenseCurve free = ten();
  free.sense.clear();
  EXPECT_TRUE(with_lines(free, {{1, 3}}, 0).sense.empty());
}

/// Points along a line between two arcs, in a curve of even nodes.
struct Given {
  DenseCurve curve;
  std::vector<FitPoint> points;
};
Given bent_line(double noise, double around, double first = 0.3, std::optional<double> after = {}) {
  Given g;
  constexpr int kCells = 200;
  double direction = 0;
  core::Point2 at{0, 0};
  for (int i = 0; i <= kCells; ++i) {
    const double t = double(i) / kCells;
    const double bend = t <= first ? around : t < 0.7 ? 0 : after.value_or(around);
    g.curve.at.push_back(t);
    g.curve.joints.push_back({at, direction, bend});
    const core::Vector2 left{-std::sin(direction), std::cos(direction)};
    if (i % 2 == 0) {
      const double off = (i / 2) % 2 == 0 ? noise : -noise;
      g.points.push_back({.position = at + off * left});
      g.curve.feet.push_back({std::min(i, kCells - 1), i == kCells ? 1.0 : 0.0});
    }
    direction += bend / kCells;
    at = at + 1.0 / kCells * core::Vector2{std::cos(direction), std::sin(direction)};
  }
  set_free(g.curve);
  return g;
}

// Errors of the noise's size: the points between are on a line.
TEST(StraightStretches, AreThePointsThatStandOnALine) {
  Given g = bent_line(1e-4, 6);
  const auto found = straight_stretches(g.curve, g.points, 1e-4);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(g.curve.at[found[0].first], 0.3, 0.04);
  EXPECT_NEAR(g.curve.at[found[0].last], 0.7, 0.04);
  // Twice as far off as the noise allows they are on none.
  EXPECT_TRUE(straight_stretches(g.curve, g.points, 0.4e-4).empty());
  // Guides do not count.
  for (FitPoint& p : g.points) p.count = 0;
  EXPECT_TRUE(straight_stretches(g.curve, g.points, 1e-4).empty());
}

// Bent as around a quarter of its length beyond, the stretch has to bow by sixty times the noise.
TEST(StraightStretches, StandOutAgainstWhatIsAround) {
  // Of 0.4 the bow is curvature * 0.16 / 8: at 1e-4 of noise that is a curvature of 0.3.
  EXPECT_EQ(
      straight_stretches(bent_line(1e-4, 0.5).curve, bent_line(1e-4, 0.5).points, 1e-4).size(), 1U);
  EXPECT_TRUE(
      straight_stretches(bent_line(1e-4, 0.1).curve, bent_line(1e-4, 0.1).points, 1e-4).empty());
}

// The stretch is 0.40 to 0.42 long, so that 60 of noise are a curvature of 0.27 to 0.30 beyond.
TEST(StraightStretches, BowBySixtyTimesTheNoise) {
  for (const double size : {1.0, 10.0})
    for (const double around : {0.26, 0.31}) {
      Given g = bent_line(1e-4, 6);
      for (std::size_t i = 0; i < g.curve.at.size(); ++i)
        if (std::abs(g.curve.at[i] - 0.5) > 0.19) g.curve.joints[i].curvature = around;
      g.curve.length = size;
      for (FitPoint& p : g.points) p.position = {size * p.position.x, size * p.position.y};
      EXPECT_EQ(straight_stretches(g.curve, g.points, 1e-4 * size).size(), around > 0.3 ? 1U : 0U)
          << around;
    }
}

// Where things lie says nothing of how straight they are.
TEST(StraightStretches, AreFoundFarFromTheOriginToo) {
  Given g = bent_line(1e-4, 6);
  const auto near = straight_stretches(g.curve, g.points, 1e-4);
  for (FitPoint& p : g.points) p.position = p.position + core::Vector2{1e5, -2e5};
  const auto far = straight_stretches(g.curve, g.points, 1e-4);
  ASSERT_EQ(far.size(), near.size());
  EXPECT_EQ(far.at(0).first, near.at(0).first);
  EXPECT_EQ(far.at(0).last, near.at(0).last);
}

/// The line between two arcs in a curve bent by `bend` where it is that far from the middle.
Given bent_beyond(double from, double to, double bend) {
  Given g = bent_line(1e-4, 6);
  for (std::size_t i = 0; i < g.curve.at.size(); ++i) {
    const double off = std::abs(g.curve.at[i] - 0.5);
    g.curve.joints[i].curvature = off > from && off < to ? bend : 0;
  }
  return g;
}

// A fillet may end before a quarter of the length is gone: by 0.03 * 6 a curve turns as one that is
// bent by 1.8 for a quarter of 0.4. By 0.03 * 0.5 it turns like one bent by 0.15, half of what
// tells.
TEST(StraightStretches, StandOutBesideShortFillets) {
  const Given fillet = bent_beyond(0.21, 0.24, 6), weak = bent_beyond(0.21, 0.24, 0.5);
  EXPECT_EQ(straight_stretches(fillet.curve, fillet.points, 1e-4).size(), 1U);
  EXPECT_TRUE(straight_stretches(weak.curve, weak.points, 1e-4).empty());
}

// Where a quarter of its length leads out of an open curve it counts by what it turns to its end,
// from 0.05 on; beyond it nothing is bent.
TEST(StraightStretches, BeyondTheEndsOfAnOpenCurveNothingIsBent) {
  Given g = bent_line(1e-4, 6, 0.05, 0.05);
  EXPECT_EQ(straight_stretches(g.curve, g.points, 1e-4).size(), 1U);
  for (std::size_t i = 0; g.curve.at[i] <= 0.05; ++i) g.curve.joints[i].curvature = 0.2;
  EXPECT_TRUE(straight_stretches(g.curve, g.points, 1e-4).empty());
  const Given strong = bent_line(1e-4, 6, 0.05, 0.5);
  EXPECT_EQ(straight_stretches(strong.curve, strong.points, 1e-4).size(), 1U);
}

/// The same from its other end.
Given reversed(const Given& g) {
  Given back = g;
  const std::size_t n = g.curve.at.size();
  for (std::size_t i = 0; i < n; ++i) {
    back.curve.joints[i] = g.curve.joints[n - 1 - i];
    back.curve.joints[i].curvature *= -1;
  }
  std::ranges::reverse(back.points);
  return back;
}

// A quarter of its length beyond either end tells a stretch, also in the first and last tenth of an
// open curve: the stretch from 0.2 to 0.7 by a bend at 0.075.
TEST(StraightStretches, EitherSideTellsThem) {
  const Given one = bent_line(1e-4, 6, 0.2, 0.05), other = reversed(one);
  EXPECT_EQ(straight_stretches(one.curve, one.points, 1e-4).size(), 1U);
  EXPECT_EQ(straight_stretches(other.curve, other.points, 1e-4).size(), 1U);
}

// From 0.1 to 0.7, a quarter of its length before a stretch of a closed curve is 0.95.
TEST(StraightStretches, OfClosedCurvesAreToldAcrossTheSeam) {
  for (const bool bent : {true, false}) {
    Given g = bent_line(1e-4, 6, 0.1, 6);
    g.curve.closed = true;
    for (std::size_t i = 0; i < g.curve.at.size(); ++i)
      g.curve.joints[i].curvature = bent && std::abs(g.curve.at[i] - 0.945) < 0.03 ? 6 : 0;
    EXPECT_EQ(straight_stretches(g.curve, g.points, 1e-4).size(), bent ? 1U : 0U);
  }
}

// The whole of an open curve is told by nothing else; what closes on itself is no line.
TEST(StraightStretches, TheWholeOfAClosedCurveIsNone) {
  Given g = bent_line(1e-4, 0);
  EXPECT_EQ(straight_stretches(g.curve, g.points, 1.5e-4).size(), 1U);
  g.curve.closed = true;
  EXPECT_TRUE(straight_stretches(g.curve, g.points, 1.5e-4).empty());
}

// Five points and twenty on the legs of an L: two lines in their order, whichever is longer.
TEST(StraightStretches, OfFivePointsAreFoundBesideLongerOnes) {
  for (const int corner : {5, 20}) {
    Given g;
    for (int i = 0; i < 25; ++i) {
      const bool up = i >= corner;
      g.curve.at.push_back(i / 24.0);
      g.curve.joints.push_back({{}, 0, 50});
      g.curve.feet.push_back({std::min(i, 23), i == 24 ? 1.0 : 0.0});
      g.points.push_back(
          {.position = {(up ? corner : i) / 24.0, (up ? i + 1 - corner : 0) / 24.0}});
    }
    set_free(g.curve);
    const auto found = straight_stretches(g.curve, g.points, 1e-6);
    ASSERT_EQ(found.size(), 2U) << corner;
    EXPECT_EQ(found[0].first, 0);
    EXPECT_EQ(found[0].last, corner - 1);
    EXPECT_EQ(found[1].first, corner);
    EXPECT_EQ(found[1].last, 24);
  }
}

// Of the ten cells of a curve a line may take two.
TEST(StraightStretches, MayBeTwoCellsLong) {
  const Given fine = bent_line(0, 6, 0.5);
  Given g;
  for (int i = 0; i <= 10; ++i) {
    g.curve.at.push_back(fine.curve.at[20 * i]);
    g.curve.joints.push_back(fine.curve.joints[20 * i]);
  }
  set_free(g.curve);
  g.points = fine.points;
  for (int i = 0; i <= 100; ++i)
    g.curve.feet.push_back({std::min(i / 10, 9), i == 100 ? 1.0 : i % 10 / 10.0});
  const auto found = straight_stretches(g.curve, g.points, 1e-6);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, 5);
  EXPECT_EQ(found[0].last, 7);
}

// 101 points by turns s to either side of a line have a mean square of s^2 * 101 / 99 about it, for
// two freedoms are the line's; two standard errors, 1 + 2 sqrt(2 / 101) times the noise's, are let
// pass.
TEST(StraightStretches, MayBeTwoStandardErrorsOff) {
  constexpr double s = 1e-4;
  const Given g = bent_line(s, 0);
  const double least = s * std::sqrt(101 / 99.0 / (1 + 2 * std::sqrt(2 / 101.0)));
  const auto found = straight_stretches(g.curve, g.points, 1.005 * least);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, 0);
  EXPECT_EQ(found[0].last, 200);
  EXPECT_TRUE(straight_stretches(g.curve, g.points, 0.995 * least).empty());
}

// A line has two freedoms, so that five points leave three to tell it by and four too few.
TEST(StraightStretches, AreOfFivePointsOrMore) {
  const Given whole = bent_line(0, 6);
  for (const std::size_t count : {5U, 4U}) {
    Given g{whole.curve, {}};
    g.curve.feet.clear();
    std::size_t inside = 0;
    for (std::size_t j = 0; j < whole.points.size(); ++j) {
      const double t = place_along(whole.curve, whole.curve.feet[j]);
      const bool apart = std::abs(t - 0.5) > 0.25;
      const bool one = std::abs(t - 0.5) < 0.165 && j % 8 == 2 && inside < count;
      if (!apart && !one) continue;
      inside += one;
      g.points.push_back(whole.points[j]);
      g.curve.feet.push_back(whole.curve.feet[j]);
    }
    ASSERT_EQ(inside, count);
    const auto found = straight_stretches(g.curve, g.points, 1e-4);
    ASSERT_EQ(found.size(), count == 5 ? 1U : 0U);
    if (found.empty()) continue;
    EXPECT_EQ(found[0].first, 68);
    EXPECT_EQ(found[0].last, 132);
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
