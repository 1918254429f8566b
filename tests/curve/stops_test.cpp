#include "keyline/curve/stops.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::curve {
namespace {

constexpr double kInfinity = HUGE_VAL;

// Near the start the cubic is the parabola 3 t^2 (2, 1) + t^3 (-3, 0), which turns left.
TEST(Stops, AHandleDrawnInHasInfiniteCurvature) {
  const Bezier2 c{{{0, 0}, {0, 0}, {2, 1}, {3, 3}}, {}};
  const auto stops = stops_of(c);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_EQ(stops[0].t, 0);
  EXPECT_FALSE(stops[0].before);
  ASSERT_TRUE(stops[0].after);
  EXPECT_EQ(stops[0].after->curvature, kInfinity);
  EXPECT_NEAR(stops[0].after->tangent.x, 2 / std::sqrt(5.0), 1e-15);
  const auto back = stops_of(reverse(c));
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].t, 1);
  ASSERT_TRUE(back[0].before);
  EXPECT_EQ(back[0].before->curvature, -kInfinity);
  EXPECT_NEAR(back[0].before->tangent.x, -2 / std::sqrt(5.0), 1e-15);
}

// x = 6 t^2 + …, y = 2 t^4: the parabola y = x^2 / 18.
TEST(Stops, CurvatureMayHaveALimit) {
  const Bezier2 c{{{0, 0}, {0, 0}, {1, 0}, {2, 0}, {3, 2}}, {}};
  ASSERT_EQ(stops_of(c).size(), 1U);
  EXPECT_NEAR(stops_of(c)[0].after->curvature, 1.0 / 9, 1e-14);
  const Bezier2 rational{c.control, {2, 2, 2, 2, 2}};
  EXPECT_NEAR(stops_of(rational)[0].after->curvature, 1.0 / 9, 1e-14);
  const Bezier2 straight{{{0, 0}, {0, 0}, {1, 1}, {3, 3}}, {}};
  EXPECT_EQ(stops_of(straight)[0].after->curvature, 0);
}

// With weights near an end with w the curve is that of no weights with x and y times w2 / w0, w3 /
// w0: what is finite changes with the weights, what is infinite keeps its sign.
TEST(Stops, OfRationalCurvesAnywhere) {
  const Bezier2 quartic{{{1e5, 2}, {1e5, 2}, {1e5 + 1, 2}, {1e5 + 2, 2}, {1e5 + 3, 4}},
                        {2, 1, 4, 1, 6}};
  ASSERT_EQ(stops_of(quartic).size(), 1U);
  // x = 6 t^2 4/2, y = 2 t^4 6/2: y = x^2 / 24.
  EXPECT_NEAR(stops_of(quartic)[0].after->curvature, 1.0 / 12, 1e-9);
  const Bezier2 cubic{{{100.1, 200.3}, {101.1, 201.3}, {103, 203.7}, {103, 203.7}}, {1, 0.7, 2, 1}};
  ASSERT_EQ(stops_of(cubic).size(), 1U);
  EXPECT_EQ(stops_of(cubic)[0].t, 1);
  const double beside = curvature(jet(cubic, 1 - 1e-4));
  EXPECT_EQ(stops_of(cubic)[0].before->curvature, std::copysign(kInfinity, beside));
}

TEST(Stops, ACuspInsideHasTwoSides) {
  const Bezier2 c{{{0, 0}, {1, 1}, {0, 1}, {1, 0}}, {}};
  const auto stops = stops_of(c);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_NEAR(stops[0].t, 0.5, 1e-12);
  EXPECT_EQ(stops[0].before->curvature, kInfinity);
  EXPECT_EQ(stops[0].after->curvature, kInfinity);
  EXPECT_NEAR(stops[0].before->tangent.y, 1, 1e-12);
  EXPECT_NEAR(stops[0].after->tangent.y, -1, 1e-12);
}

TEST(Stops, NoneWhereACurveGoesOn) {
  EXPECT_TRUE(stops_of(Bezier2{{{0, 0}, {1e-9, 0}, {2, 1}, {3, 3}}, {}}).empty());
  EXPECT_TRUE(stops_of(Bezier2{{{0, 0}, {1, 1}, {0.01, 1}, {1, 0}}, {}}).empty());
  EXPECT_TRUE(stops_of(Bezier2{{{5, 5}, {5, 5}, {5, 5}}, {}}).empty());
}

TEST(Stops, KnotsThatTheParameterCannotTellApartAreNone) {
  const BSpline2 c{
      2, {-1, -1, -1, 0, 1e-16, 1, 1, 1}, {{0, 0}, {1, 0}, {2, 1}, {3, 3}, {3, 3}}, {}};
  const auto stops = stops_of(c);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_EQ(stops[0].t, 1);
}

// A triple knot: the spline stops on one side of it alone.
TEST(Stops, OfASplineMayHaveOneSide) {
  const BSpline2 c{3,
                   {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2},
                   {{0, 0}, {1, 2}, {2, 2}, {3, 1}, {3, 1}, {4, 0}, {5, 0}},
                   {}};
  const auto stops = stops_of(c);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_EQ(stops[0].t, 0.5);
  EXPECT_FALSE(stops[0].before);
  EXPECT_EQ(stops[0].after->curvature, kInfinity);
}

}  // namespace
}  // namespace keyline::curve
