#include "keyline/acquire/going_on.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::acquire {
namespace {

using core::Point2;

/// Points of a line up to its last one, a step apart.
std::vector<Point2> towards(Point2 last, core::Vector2 step) {
  std::vector<Point2> points;
  for (int i = 8; i >= 0; --i) points.push_back(last - i * step);
  return points;
}

TEST(CornerBeyond, IsWhereTheSidesMeetAheadOfBoth) {
  const auto one = towards({0, 0}, {1, 0});
  const auto met = corner_beyond(one, towards({0.6, 0.4}, {0, -1}));
  ASSERT_TRUE(met);
  EXPECT_NEAR(met->x, 0.6, 1e-12);
  EXPECT_NEAR(met->y, 0, 1e-12);
  EXPECT_FALSE(corner_beyond(one, towards({-0.6, 0.4}, {0, -1}))) << "behind one's end";
  EXPECT_FALSE(corner_beyond(one, towards({0.6, -0.4}, {0, -1}))) << "behind the other's";
  EXPECT_FALSE(corner_beyond(one, towards({1, 0.4}, {-1, 0}))) << "side by side";
  EXPECT_FALSE(corner_beyond(one, towards({3, 0.5}, {-1, -0.12}))) << "too far ahead";
}

// Circles of radius 5 about (-3, 0) and (3, 0) meet in (0, 4), at 53.13 degrees.
TEST(CornerBeyond, SidesMayBeBent) {
  std::vector<Point2> one, other;
  for (int i = 9; i >= 0; --i) {
    const double angle = (53.13010235415598 - 1 - 2 * i) * std::numbers::pi / 180;
    one.push_back({5 * std::cos(angle) - 3, 5 * std::sin(angle)});
    other.push_back({-one.back().x, one.back().y});
  }
  const auto met = corner_beyond(one, other);
  ASSERT_TRUE(met);
  EXPECT_NEAR(met->x, 0, 1e-9);
  EXPECT_NEAR(met->y, 4, 1e-3);
}

TEST(DistanceBeyond, IsThatOfTheNearestPolynomial) {
  EXPECT_NEAR(*distance_beyond(towards({0, 0}, {1, 0}), {1, 0.5}), 0.5, 1e-12);
  std::vector<Point2> parabola;  // y = x^2 / 100
  for (int i = -9; i <= 0; ++i) parabola.push_back({0.1 * i, 1e-4 * i * i});
  EXPECT_NEAR(*distance_beyond(parabola, {0.1, 1e-4}), 0, 1e-8);
  EXPECT_FALSE(distance_beyond(std::vector<Point2>(5, Point2{0, 0}), {1, 0}));
}

}  // namespace
}  // namespace keyline::acquire
