#include "keyline/acquire/corners.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::acquire {
namespace {

using core::Point2;
using Corners = std::vector<std::size_t>;

constexpr double kAngle = 0.6;  // radians, as by default

/// The nose of an ellipse with half axes 1 and 0.09, as wide apart at its tip as `step` (of its
/// parameter), closer by `closer` beside it, from there on wider again by an eighth each.
std::vector<Point2> nose(double step, double closer) {
  std::vector<double> side{step};
  for (double next = step / closer; side.back() < 2.6; next *= 1.12) {
    side.push_back(side.back() + next);
  }
  std::vector<double> parameters(side.rbegin(), side.rend());
  for (double& t : parameters) t = -t;
  parameters.push_back(0);
  parameters.insert(parameters.end(), side.begin(), side.end());
  std::vector<Point2> points;
  for (const double t : parameters) points.push_back({1 - std::cos(t), 0.09 * std::sin(t)});
  return points;
}

/// The same nose by even steps along it, its tip half way between two points.
std::vector<Point2> even_nose(double half_axis, double step) {
  const auto at = [half_axis](double t) {
    return Point2{1 - std::cos(t), half_axis * std::sin(t)};
  };
  std::vector<Point2> side;
  double length = 0;
  for (double t = 0; t < 1.5; t += 1e-4) {
    length += core::distance(at(t), at(t + 1e-4));
    if (length >= step * (static_cast<double>(side.size()) + 0.5)) side.push_back(at(t + 1e-4));
  }
  std::vector<Point2> points;
  for (auto p = side.rbegin(); p != side.rend(); ++p) points.push_back({p->x, -p->y});
  points.insert(points.end(), side.begin(), side.end());
  return points;
}

// An ellipse has no corner, however its points are spread.
TEST(Corners, NoneAtANoseWithPointsCloserBesideItsTip) {
  for (const double step : {0.05, 0.08, 0.1, 0.12}) {
    for (const double closer : {1.0, 1.5, 2.0, 2.5}) {
      EXPECT_EQ(find_corners(nose(step, closer), false, 0, kAngle), Corners{})
          << step << " closer by " << closer;
    }
  }
}

/// The parabola y^2 = 4 x at even steps of y, its tip among them: there it turns by 2 atan(step /
/// 4).
std::vector<Point2> parabola(double step) {
  std::vector<Point2> points;
  for (int i = -8; i <= 8; ++i) points.push_back({step * step * i * i / 4, step * i});
  return points;
}

// A parabola has no corner: turns of 37 to 112 degrees at its tip go on from those beside it.
TEST(Corners, NoneAtATipThatOnePointTells) {
  for (const double step : {1.5, 2.0, 3.0, 4.0, 5.0, 6.0})
    EXPECT_EQ(find_corners(parabola(step), false, 0, kAngle), Corners{}) << step;
}

// One half of it, a line for the other: on that side nothing grows towards the corner.
TEST(Corners, FoundWhereABendEnds) {
  for (const double step : {3.0, 4.0, 5.0}) {
    std::vector<Point2> points = parabola(step);
    for (std::size_t i = 9; i < points.size(); ++i) points[i] = {step * (i - 8.0), 0};
    EXPECT_EQ(find_corners(points, false, 0, kAngle), Corners{8}) << step;
  }
}

// A polyline with one edge between a corner and the next, which turns the other way: the sharper
// one is it.
TEST(Corners, FoundBesideACornerThatTurnsTheOtherWay) {
  const auto step = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return core::Vector2{std::cos(angle), std::sin(angle)};
  };
  for (const double turn : {120.0, 140.0}) {
    std::vector<Point2> points{{0, 0}};
    for (int i = 0; i < 20; ++i) points.push_back(points.back() + step(0));
    points.push_back(points.back() + step(turn));
    for (int i = 0; i < 20; ++i) points.push_back(points.back() + step(25));
    EXPECT_EQ(find_corners(points, false, 0, kAngle), Corners{20}) << turn;
  }
}

// The foot of a letter: what turns as much two arms on is a corner of its own, not a bend about the
// first. With this noise an arm is two points long.
TEST(Corners, MayStandTwoArmsApart) {
  for (const double side : {1.0, -1.0}) {
    std::vector<Point2> points;
    for (int i = 0; i < 10; ++i) points.push_back({static_cast<double>(i), 0});
    for (int i = 0; i < 4; ++i) points.push_back({10, static_cast<double>(i)});
    for (int i = 0; i <= 10; ++i) points.push_back({10 + side * i, 4});
    EXPECT_EQ(find_corners(points, false, 0.1, kAngle), (Corners{10, 14})) << side;
  }
}

// The radius of its tips is more than twice the distance of the points there, which err by a ninth
// of that.
TEST(Corners, HardlyEverAtTheTipsOfAMeasuredEllipse) {
  std::mt19937 engine(1);
  std::normal_distribution<double> error(0, 0.003);
  int cornered = 0;
  for (int round = 0; round < 100; ++round) {
    std::vector<Point2> points;
    for (int i = 0; i < 60; ++i) {
      const double t = 2 * std::numbers::pi * (i + 0.3) / 60;
      points.push_back({std::cos(t) + error(engine), 0.25 * std::sin(t) + error(engine)});
    }
    if (!find_corners(points, true, 0.003, kAngle).empty()) ++cornered;
  }
  EXPECT_LE(cornered, 3);
}

/// Two arcs of radius 1 that meet at the origin, where the direction turns by `turn` against the
/// way they bend; steps along them of `before` and `after`.
std::vector<Point2> two_arcs(double turn, double before, double after) {
  std::vector<Point2> points;
  for (int i = 20; i > 0; --i) {
    const double s = before * i;
    points.push_back({-std::sin(s), 1 - std::cos(s)});
  }
  for (int i = 0; i <= 20; ++i) {
    const double s = after * i;
    const Point2 p{std::sin(s), 1 - std::cos(s)};
    points.push_back({std::cos(turn) * p.x + std::sin(turn) * p.y,
                      -std::sin(turn) * p.x + std::cos(turn) * p.y});
  }
  return points;
}

// Arcs that turn by 0.02 to 0.1 at each point: a jump of a right angle less 10 degrees is a corner
// whichever side has its points closer.
TEST(Corners, FoundWhereArcsMeetThatAreSampledUnevenly) {
  const double turn = 80 * std::numbers::pi / 180;
  for (const double before : {0.02, 0.05, 0.1}) {
    for (const double after : {0.02, 0.05, 0.1}) {
      EXPECT_EQ(find_corners(two_arcs(turn, before, after), false, 0, kAngle), Corners{20})
          << before << ", " << after;
    }
  }
}

/// From the origin on, along the direction given: one long step, then short ones that turn by
/// `bend` each.
std::vector<Point2> flank(double direction, double bend) {
  std::vector<Point2> points{{0.3 * std::cos(direction), 0.3 * std::sin(direction)}};
  for (int i = 0; i < 12; ++i) {
    direction += bend * (i < 4 ? 1 : 0);
    const Point2 last = points.back();
    points.push_back({last.x + 0.06 * std::cos(direction), last.y + 0.06 * std::sin(direction)});
  }
  return points;
}

// A tip that turns by 150 degrees beside tight bends of closer points: by so much at one point
// turns no bend that is sampled.
TEST(Corners, FoundAtATipBesideTightBends) {
  const double degree = std::numbers::pi / 180;
  const std::vector<Point2> after = flank(-15 * degree, -40 * degree);
  const std::vector<Point2> before = flank(15 * degree, 40 * degree);
  std::vector<Point2> points(before.rbegin(), before.rend());
  points.push_back({0, 0});
  points.insert(points.end(), after.begin(), after.end());
  EXPECT_EQ(find_corners(points, false, 0, kAngle), Corners{before.size()});
}

/// Two sides that meet at the origin under `turn`, the second with another bend, sampled by steps
/// of 1 along them; the last point of the first is `before` away from it.
std::vector<Point2> two_sides(double turn, double before) {
  const auto side = [](double bend, double s) {
    return bend == 0 ? Point2{s, 0}
                     : Point2{std::sin(bend * s) / bend, (1 - std::cos(bend * s)) / bend};
  };
  std::vector<Point2> points;
  for (int i = 14; i >= 0; --i) points.push_back(side(0.02, -i - before));
  for (int i = 0; i < 15; ++i) {
    const Point2 p = side(-0.03, 1 - before + i);
    points.push_back(
        {std::cos(turn) * p.x - std::sin(turn) * p.y, std::sin(turn) * p.x + std::cos(turn) * p.y});
  }
  return points;
}

// Wherever the corner lies between the two points: one of them stands for it.
TEST(Corners, FoundBetweenPoints) {
  for (const double degrees : {45.0, 70.0, 100.0, -60.0}) {
    for (const double before : {0.3, 0.4, 0.5, 0.6, 0.7}) {
      const auto points = two_sides(degrees * std::numbers::pi / 180, before);
      const Corners found = find_corners(points, false, 0, kAngle);
      ASSERT_EQ(found.size(), 1U) << degrees << ", " << before;
      EXPECT_NEAR(static_cast<double>(found.front()), 14.5, 0.5) << degrees << ", " << before;
    }
  }
}

// A bend by 90 degrees with a radius of 1.27 steps, or a chamfer, sampled at both its ends: round a
// corner it would be farther than from point to point.
TEST(Corners, NoneInARoundingAsLongAsAStep) {
  std::vector<Point2> points;
  for (int i = 14; i >= 0; --i) points.push_back({-0.7071 - i, 0});
  for (int i = 0; i < 15; ++i) points.push_back({0, 0.7071 + i});
  EXPECT_EQ(find_corners(points, false, 0, kAngle), Corners{});
}

// Noses of ellipses and tips of parabolas that lie between two points, sampled evenly along them.
TEST(Corners, NoneAtATipThatTwoPointsTell) {
  for (const double half_axis : {0.05, 0.1, 0.2, 0.4}) {
    for (const double step : {0.02, 0.04, 0.06, 0.1}) {
      EXPECT_EQ(find_corners(even_nose(half_axis, step), false, 0, kAngle), Corners{})
          << half_axis << ", " << step;
    }
  }
  for (const double step : {1.5, 2.0, 3.0}) {
    std::vector<Point2> points;
    for (double y = -9.5 * step; y < 10 * step; y += step) points.push_back({y * y / 4, y});
    EXPECT_EQ(find_corners(points, false, 0, kAngle), Corners{}) << step;
  }
}

}  // namespace
}  // namespace keyline::acquire
