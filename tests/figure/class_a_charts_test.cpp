#include "keyline/figure/class_a_charts.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/error.h"

#include "picture.h"

namespace keyline::figure {
namespace {

using core::Point2;

template <class F>
Grid sampled(int columns, int rows, F f) {
  Grid grid{{-1, -1}, {1, 1}, columns, rows, {}};
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      grid.values.push_back(f(-1 + 2.0 * i / (columns - 1), -1 + 2.0 * j / (rows - 1)));
  return grid;
}

TEST(ContourLines, CloseAroundAHill) {
  const Grid hill = sampled(81, 61, [](double x, double y) { return x * x + y * y; });
  const auto lines = contour_lines(hill, 0.25);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  EXPECT_GT(lines[0].size(), 50U);
  for (const Point2& p : lines[0]) EXPECT_NEAR(std::hypot(p.x, p.y), 0.5, 2e-3);
}

TEST(ContourLines, EndAtTheBorderAndAtHoles) {
  const Grid slope = sampled(21, 21, [](double x, double) { return x; });
  const auto line = contour_lines(slope, 0.33);
  ASSERT_EQ(line.size(), 1U);
  EXPECT_EQ(line[0].size(), 21U);
  EXPECT_NEAR(line[0][7].x, 0.33, 1e-12);
  Grid holed = slope;
  for (std::size_t i = 0; i < 21; ++i) holed.values[10 * 21 + i] = NAN;
  EXPECT_EQ(contour_lines(holed, 0.33).size(), 2U);
  EXPECT_TRUE(contour_lines(slope, 7).empty());
}

TEST(ContourLines, KeepTheBranchesOfASaddleApart) {
  const Grid saddle = sampled(20, 20, [](double x, double y) { return x * y; });
  EXPECT_EQ(contour_lines(saddle, 0.05).size(), 2U);
  EXPECT_EQ(contour_lines(saddle, -0.05).size(), 2U);
  // One cell that is a saddle itself: two lines, whichever way it is decided.
  EXPECT_EQ(contour_lines(Grid{{0, 0}, {1, 1}, 2, 2, {1, 0, 0, 1}}, 0.4).size(), 2U);
  EXPECT_EQ(contour_lines(Grid{{0, 0}, {1, 1}, 2, 2, {1, 0, 0, 1}}, 0.6).size(), 2U);
  EXPECT_THROW(contour_lines(Grid{{0, 0}, {1, 1}, 2, 2, {1}}, 0), core::InvalidInput);
}

TEST(EvenLevels, RiseAndSkipHoles) {
  const Grid slope = sampled(21, 21, [](double x, double) { return x > 0.9 ? NAN : x; });
  const auto levels = even_levels(slope, 4);
  ASSERT_EQ(levels.size(), 4U);
  EXPECT_TRUE(std::is_sorted(levels.begin(), levels.end()));
  EXPECT_TRUE(even_levels({}, 4).empty());
}

TEST(AlphaSChart, ShowsRegionPointsAndContours) {
  AlphaSPlane plane;
  plane.points = {{"given", 0.785, 1.05, Marker::square}, {"minimum", 0.6474, 1.4404}};
  plane.path = {{0.785, 1.05}, {0.6474, 1.4404}};
  plane.energy = sampled(41, 41, [](double x, double y) { return x * x + 2 * y * y; });
  plane.energy->low = {0, 0.4};
  plane.energy->high = {1.0982, 2.4};
  const Drawing d = alpha_s_chart(plane);
  const std::string svg = write_svg(d);
  EXPECT_NE(svg.find(">given</text>"), std::string::npos);
  EXPECT_NE(svg.find(">minimum</text>"), std::string::npos);
  EXPECT_NE(svg.find("data-name=\"regions\""), std::string::npos);
  const auto png = write_png(d, 1);
  ASSERT_TRUE(png);
  EXPECT_GT(Decoded(*png).count_other_than(0xFFFFFFU), 20000);
  plane.alpha_max = 2;
  EXPECT_THROW(alpha_s_chart(plane), core::InvalidInput);
  plane = {};
  plane.s = {-1, 1};
  EXPECT_THROW(alpha_s_chart(plane), core::InvalidInput);
}

TEST(RasterFigure, PlacesPixelsAndScale) {
  RasterFigure f{.title = "Zebra", .columns = 2, .rows = 1, .rgb = {0, 0, 0, 255, 255, 255}};
  f.scale = ColorScale{"Gaussian curvature [1/mm²]", -1e-3, 2e-3};
  const Drawing d = raster_figure(f);
  const auto png = write_png(d, 1);
  ASSERT_TRUE(png);
  const Decoded picture(*png);
  EXPECT_EQ(picture.at(100, 200), 0x000000U);
  EXPECT_EQ(picture.at(600, 200), 0xFFFFFFU);
  EXPECT_NE(write_svg(d).find("−0.001"), std::string::npos);
  f.rgb.pop_back();
  EXPECT_THROW(raster_figure(f), core::InvalidInput);
}

TEST(BeforeAfterChart, ShowsBothCurves) {
  BeforeAfter pair;
  EXPECT_THROW(before_after_chart(pair), core::InvalidInput);
  pair.before.points = {{0, 0}, {1, 1}, {2, 1}};
  pair.after.points = {{0, 0}, {1, 0.5}, {2, 1}};
  pair.after_control = {{0, 0}, {1, 0.2}, {2, 1}};
  const std::string svg = write_svg(before_after_chart(pair));
  EXPECT_NE(svg.find("before"), std::string::npos);
  EXPECT_NE(svg.find("after"), std::string::npos);
}

}  // namespace
}  // namespace keyline::figure
