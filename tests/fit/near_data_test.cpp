#include "keyline/fit/near_data.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/curve/bspline.h"
#include "keyline/fit/fit_spline.h"

namespace keyline::fit {
namespace {

// Of order 2 with a knot at 1/2 the first datum decides the value at 0 and the other two the line
// through them, which is 2 - 1 / (4 delta) at the knot: it leaves the room from -1 to 5 about the
// values 1 to 3 where delta < 1/12.
TEST(NearData, APolygonLeavesItsDataAtAKnot) {
  const auto sum = [](double delta) {
    SplineData data{{0, 0.75, 0.75 + delta}, {{1, 2, 3}}, {}};
    SplineSolver solver(data, {0, 1}, 2);
    const double knots[] = {0.5};
    EXPECT_TRUE(std::isfinite(solver.sum_of_squares(knots)));
    const double near = solver.sum_near_data(knots);
    EXPECT_EQ(solver.solve_near_data(knots), std::isfinite(near));
    return near;
  };
  EXPECT_TRUE(std::isfinite(sum(1.0 / 12 + 1e-9)));
  EXPECT_TRUE(std::isinf(sum(1.0 / 12 - 1e-9)));
  EXPECT_TRUE(std::isinf(sum(1e-6)));
}

// Beyond the last datum the same polygon may go where it likes, and between data a parabola may
// rise as far as they are apart: 8 (1 - x) x over values 0 to 1 comes to 2.
TEST(NearData, WhatCountsLiesBetweenTheData) {
  const SplineData data{{0, 0.5}, {{0, 1}}, {}};
  const LeastSquaresSpline steep{2, {0, 0, 0.5, 1, 1}, {{0, 1, 100}}, 0};
  EXPECT_TRUE(detail::stays_near(steep, data));
  const SplineData both{{0, 1}, {{0, 1}}, {}};
  EXPECT_FALSE(detail::stays_near(steep, both));
  const auto hump = [&](double rise) {
    return detail::stays_near({3, {0, 0, 0, 1, 1, 1}, {{0, 2 * rise, 0}}, 0}, both);
  };
  EXPECT_TRUE(hump(2 - 1e-9));
  EXPECT_FALSE(hump(2 + 1e-9));
  EXPECT_FALSE(hump(-1 - 1e-9));
}

// Of two columns the longer range is the room of both.
TEST(NearData, TheBoxOfAPlaneCurveIsWidenedByItsLongerEdge) {
  const SplineData data{{0, 1}, {{0, 10}, {0, 1}}, {}};
  const auto room = detail::room_about(data);
  EXPECT_EQ(room[0], (core::Interval{-10, 20}));
  EXPECT_EQ(room[1], (core::Interval{-10, 11}));
}

// The search put a knot nearer to the start than any point, whose neighbour's foot alone decided
// two control points: 3.8e9 of a line of 50.
TEST(NearData, FittedCurvesStayNearTheirPoints) {
  const std::vector<core::Point2> points = {
      {-44.60525237170774, -63.498642935212686}, {-41.394808684980546, -62.849114913419754},
      {-38.25355176908244, -62.212350489455964}, {-35.11126759090023, -61.524063223738196},
      {-31.99061933219749, -61.1546625927638},   {-29.027601202356763, -61.0507488355099},
      {-26.033364821704712, -61.21067152935499}, {-23.22755815497282, -61.57660743660225},
      {-20.390430325018805, -62.17340826924311}, {-17.60328024592392, -62.75444670139722},
      {-14.749533697812105, -63.21950212340557}, {-11.839382590276934, -63.47859053836842},
      {-8.72604412672316, -63.22848303096402},   {-5.523601028452916, -62.552004247367215},
      {-2.2025586074971883, -61.28116312698188}, {1.3330207085517074, -59.314939123819734}};
  SplineFitOptions options;
  options.population = 10;
  options.generations = 6;
  options.trials = 1;
  options.must_pass = {0, 8};
  const auto fit = fit_spline(points, {}, options);
  ASSERT_TRUE(fit);
  for (int i = 0; i <= 2000; ++i) {
    const core::Point2 p =
        curve::evaluate(fit->curve, curve::parameter_at_knot(fit->curve, i / 2000.0));
    EXPECT_NEAR(p.x, -21.6, 23 + 46);
    EXPECT_NEAR(p.y, -61.4, 2.1 + 46);
  }
  EXPECT_LT(fit->bic, -59.4);  // of the knots with control points 3.8e9 away: -59.4201
}

}  // namespace
}  // namespace keyline::fit
