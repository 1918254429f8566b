#include "keyline/fit/jump_spline.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::fit::detail {
namespace {

struct Case {
  double penalty;
  std::array<double, 3> at;
  std::array<core::Point2, 3> values;
};

void expect_values(JumpSpline& spline, const Case& c) {
  SCOPED_TRACE(c.penalty);
  ASSERT_TRUE(spline.solve(c.penalty));
  for (std::size_t i = 0; i < c.at.size(); ++i) {
    const core::Point2 p = evaluate(spline.spline(), c.at[i]);
    EXPECT_NEAR(p.x, c.values[i].x, 1e-8);
    EXPECT_NEAR(p.y, c.values[i].y, 1e-8);
  }
}

// Values by scipy 1.10: dense normal equations of BSpline.design_matrix and of the differences of
// BSpline.derivative(5) on both sides of the knots.
TEST(JumpSpline, HasScipysValues) {
  PlacedPoints data;
  for (int i = 0; i < 13; ++i) {
    const double at = std::pow(i / 12.0, 1.5);
    data.at.push_back(at);
    data.points.push_back({3 * at, std::sin(5 * at) + (i % 3 == 0 ? 0.1 : 0)});
  }
  JumpSpline spline(data, std::array<std::size_t, 4>{0, 4, 7, 12});
  const std::array<double, 3> at{0.1, 0.5, 0.83};
  expect_values(spline,
                {0, at, {{{0.3, 0.505410515596}, {1.5, 0.634396210793}, {2.49, -0.844846031391}}}});
  expect_values(
      spline,
      {1e-3, at, {{{0.3, 0.500019611111}, {1.5, 0.625452178744}, {2.49, -0.842247428607}}}});
  expect_values(
      spline, {10, at, {{{0.3, 0.509952455042}, {1.5, 0.639109142468}, {2.49, -0.840851283523}}}});
  const core::Point2 there = evaluate(spline.spline(), data.at[5]);
  EXPECT_NEAR(spline.offset(5).y, there.y - data.points[5].y, 1e-14);
}

// The same, the splines of each knot and of those a period on added up.
TEST(JumpSpline, HasScipysValuesWhereItIsClosed) {
  PlacedPoints data{.points = {}, .at = {}, .closed = true};
  for (int i = 0; i < 12; ++i) {
    const double at = (i + 0.2 * std::sin(2 * i)) / 12;
    const double angle = 2 * std::numbers::pi * at;
    data.at.push_back(at);
    data.points.push_back({2 * std::cos(angle), std::sin(angle) + (i % 4 == 1 ? 0.1 : 0)});
  }
  JumpSpline spline(data, std::array<std::size_t, 7>{0, 2, 3, 5, 8, 10, 12});
  const std::array<double, 3> at{0.1, 0.5, 0.97};
  expect_values(spline, {0,
                         at,
                         {{{1.61690490675, 0.63190471268},
                           {-1.99785012227, 0.0427978261927},
                           {1.96444039158, -0.194893409732}}}});
  expect_values(spline, {1e-3,
                         at,
                         {{{1.61691988416, 0.631253192666},
                           {-1.99783461676, 0.0421656860119},
                           {1.96442337476, -0.193888934195}}}});
  expect_values(spline, {10,
                         at,
                         {{{1.62036638566, 0.613432871547},
                           {-1.99082737212, 0.0256986498583},
                           {1.96684577329, -0.166965080549}}}});
}

}  // namespace
}  // namespace keyline::fit::detail
