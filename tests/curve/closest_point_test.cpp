#include "keyline/curve/closest_point.h"

#include <cmath>

#include <gtest/gtest.h>

#include "test_curves.h"

namespace keyline::curve {
namespace {

using core::Point2;

template <class C>
void expect_nearest(const C& c, Point2 p) {
  const ClosestPoint found = closest_point(c, p);
  EXPECT_LT(distance(found.point, evaluate(c, found.t)), 1e-12);
  EXPECT_NEAR(found.distance, distance(p, found.point), 1e-15);
  double sampled = 1e300;
  for (const Point2& q : sample(c, 4001)) sampled = std::min(sampled, distance(p, q));
  EXPECT_LE(found.distance, sampled + 1e-13);
  EXPECT_GE(found.distance, sampled - 2e-2);
}

TEST(ClosestPoint, BeatsDenseSamples) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    Draw draw(1000 + seed);
    const Bezier2 b = random_bezier(seed, 1 + static_cast<int>(seed) % 9, seed % 2 == 1);
    const BSpline2 s = random_spline(seed, 1 + static_cast<int>(seed) % 5, 9, seed % 2 == 0);
    const Point2 p{draw(-1, 1), draw(-1, 1)};
    expect_nearest(b, p);
    expect_nearest(s, p);
    expect_nearest(PlanarView(b), p);
    expect_nearest(s, evaluate(s, draw(0, 1)));
  }
}

TEST(ClosestPoint, CentreOfACircleIsNoTrap) {
  const ClosestPoint c = closest_point(quarter_circle(), {0, 0});
  EXPECT_NEAR(c.distance, 1, 1e-15);
}

TEST(ClosestPoint, PointOnTheCurveComesBack) {
  const Bezier2 c = random_bezier(7, 5);
  for (const double t : {0.0, 0.123, 0.5, 0.987, 1.0}) {
    const ClosestPoint found = closest_point(c, evaluate(c, t));
    EXPECT_LT(found.distance, 1e-14);
  }
}

TEST(ClosestPoint, DegenerateCurves) {
  EXPECT_EQ(closest_point(Bezier2{{{1, 1}, {1, 1}, {1, 1}}, {}}, {1, 3}).distance, 2);
  const Polyline2 line{{{0, 0}, {2, 0}, {2, 0}, {2, 2}}};
  EXPECT_DOUBLE_EQ(closest_point(line, {1, -3}).t, 0.5 / 3);
  EXPECT_EQ(closest_point(line, {5, 5}).t, 1);
}

}  // namespace
}  // namespace keyline::curve
