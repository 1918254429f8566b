#include "keyline/fairing/straight_run.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::fairing::detail {
namespace {

std::vector<FitPoint> points_on_a_line() {
  std::vector<FitPoint> points;
  for (int i = 0; i <= 40; ++i) {
    const double t = i / 40.0;
    points.push_back({.position = {0.6 * t, 0.8 * t}});
  }
  return points;
}

TEST(StraightRun, IsOneLineFromTheFirstPointToTheLast) {
  const auto points = points_on_a_line();
  const auto chain = straight_chain(points);
  ASSERT_TRUE(chain);
  ASSERT_EQ(chain->pieces.size(), 1u);
  EXPECT_EQ(chain->pieces[0].kind, PieceKind::line);
  EXPECT_NEAR(chain->pieces[0].length, 1, 1e-15);
  for (const double offset : offsets(*chain, points)) EXPECT_NEAR(offset, 0, 1e-15);
}

TEST(StraightRun, IsNoneWherePointsBendOrTurnBack) {
  auto bent = points_on_a_line();
  bent[20].position.x += 1e-9;
  EXPECT_FALSE(straight_chain(bent));
  auto back = points_on_a_line();
  std::swap(back[20], back[21]);
  EXPECT_FALSE(straight_chain(back));
  EXPECT_FALSE(straight_chain({}));
}

TEST(StraightRun, PointsMayBeOffByRoundingAndNoMore) {
  auto points = points_on_a_line();
  points[7].high = 0.9e-12;
  EXPECT_TRUE(straight_chain(points));
  points[7].high = 1.1e-12;
  EXPECT_FALSE(straight_chain(points));
  points[7].high = 0;
  points[7].low = -1.1e-12;
  EXPECT_FALSE(straight_chain(points));
  auto twice = points_on_a_line();
  twice[3] = twice[2];
  EXPECT_FALSE(straight_chain(twice));
  auto back = points_on_a_line();
  back.back() = back.front();
  EXPECT_FALSE(straight_chain(back));  // no length
  const auto two = points_on_a_line();
  EXPECT_TRUE(straight_chain({two[0], two[9]}));
  EXPECT_FALSE(straight_chain({two[0]}));
  const auto chain = straight_chain(points_on_a_line()).value();
  for (std::size_t j = 0; j <= 40; ++j) EXPECT_NEAR(chain.feet[j].fraction, j / 40.0, 1e-15);
  EXPECT_NEAR(chain.joints[1].direction, std::atan2(0.8, 0.6), 1e-15);
}

/// Points of a circle of this radius about (1, -2), from one angle on.
std::vector<FitPoint> on_circle(double radius, double from, double turn, int n) {
  std::vector<FitPoint> points;
  for (int i = 0; i < n; ++i) {
    const double t = from + turn * i / (n - 1);
    points.push_back({.position = {1 + radius * std::cos(t), -2 + radius * std::sin(t)}});
  }
  return points;
}

// Either way round, less than a circle and more: direction, curvature, length and feet are known.
TEST(ArcRun, IsTheArcThroughItsPoints) {
  for (const double sense : {1.0, -1.0})
    for (const auto& [turn, n] : {std::pair{0.7, 3}, {3.0, 5}, {4.5, 12}, {7.0, 20}}) {
      const double radius = 1 / turn, from = 0.4;
      const auto points = on_circle(radius, from, sense * turn, n);
      const auto chain = arc_chain(points);
      ASSERT_TRUE(chain) << turn << ' ' << sense;
      ASSERT_EQ(chain->pieces.size(), 1U);
      EXPECT_EQ(chain->pieces[0].kind, PieceKind::arc);
      EXPECT_NEAR(chain->pieces[0].length, 1, 1e-11);
      for (const FitJoint& joint : chain->joints) EXPECT_NEAR(joint.curvature, sense * turn, 1e-10);
      const double start = from + sense * M_PI / 2;
      EXPECT_NEAR(std::remainder(chain->joints[0].direction - start, 2 * M_PI), 0, 1e-11);
      EXPECT_NEAR(chain->joints[1].direction - chain->joints[0].direction, sense * turn, 1e-11);
      EXPECT_EQ(chain->joints[0].position, points.front().position);
      EXPECT_EQ(chain->joints[1].position, points.back().position);
      ASSERT_EQ(chain->feet.size(), points.size());
      for (int i = 0; i < n; ++i)
        EXPECT_NEAR(chain->feet[i].fraction, i / (n - 1.0), 1e-11) << turn;
    }
}

// Farther from each other than half a turn: the way round is told by the points' order.
TEST(ArcRun, ThreePointsAlwaysLieOnOne) {
  const auto points = on_circle(0.2, 0.3, 5, 3);
  std::vector<FitPoint> uneven = points;
  uneven[1].position = on_circle(0.2, 0.3, 4.4, 2)[1].position;
  const auto chain = arc_chain(uneven);
  ASSERT_TRUE(chain);
  EXPECT_NEAR(chain->pieces[0].length, 1, 1e-11);
  EXPECT_NEAR(chain->feet[1].fraction, 0.88, 1e-11);
}

// However near two of them are: here a millionth of the way to the first.
TEST(ArcRun, PointsMayBeUneven) {
  auto points = on_circle(10, 0.3, 0.1, 3);
  points[1].position = on_circle(10, 0.3, 0.1 * (1 - 1e-6), 2)[1].position;
  for (const bool reversed : {false, true}) {
    if (reversed) std::ranges::reverse(points);
    const auto chain = arc_chain(points);
    ASSERT_TRUE(chain);
    EXPECT_NEAR(chain->joints[0].curvature, reversed ? -0.1 : 0.1, 1e-8);
    EXPECT_NEAR(chain->pieces[0].length, 1, 1e-9);
  }
}

// Of points beside it the arc of least squares: six errors that cancel in its three unknowns.
TEST(ArcRun, IsThatOfLeastSquaresWithinATolerance) {
  const double turn = 0.02, off = 1e-4;
  auto points = on_circle(1 / turn, 0.4, turn, 41);
  for (int i = 0; i < 41; ++i) {
    const double t = 0.4 + turn * i / 40, x = i / 20.0 - 1;
    const double by = off * (5 * x * x * x - 3 * x) / 2;  // no constant, line or parabola in it…
    points[static_cast<std::size_t>(i)].position.x += by * std::cos(t);
    points[static_cast<std::size_t>(i)].position.y += by * std::sin(t);
  }
  EXPECT_FALSE(arc_chain(points));
  EXPECT_FALSE(arc_chain(points, 0.9 * off));
  const auto chain = arc_chain(points, 1.1 * off);
  ASSERT_TRUE(chain);
  EXPECT_NEAR(chain->joints[0].curvature, turn, 0.01 * turn);  // …but for the sums being of 41
  EXPECT_NEAR(chain->pieces[0].length, 1, 1e-4);
}

TEST(ArcRun, IsNoneWherePointsAreOffOrTurnBack) {
  EXPECT_FALSE(arc_chain(points_on_a_line()));
  EXPECT_FALSE(arc_chain({}));
  EXPECT_FALSE(arc_chain(on_circle(0.3, 0, 1, 2)));
  auto off = on_circle(0.3, 0, 2, 9);
  ASSERT_TRUE(arc_chain(off));
  off[2].high = 2e-12;
  EXPECT_FALSE(arc_chain(off));
  off[2].high = 0;
  off[2].position.x += 1e-9;
  EXPECT_FALSE(arc_chain(off));
  auto back = on_circle(0.3, 0, 2, 9);
  std::swap(back[5], back[6]);
  EXPECT_FALSE(arc_chain(back));
  auto twice = on_circle(0.3, 0, 2, 9);
  twice[5] = twice[6];
  EXPECT_FALSE(arc_chain(twice));
}

}  // namespace
}  // namespace keyline::fairing::detail
