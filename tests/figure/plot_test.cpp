#include "keyline/figure/plot.h"

#include <cmath>

#include <gtest/gtest.h>

#include "picture.h"

namespace keyline::figure {
namespace {

Plot sample_plot() {
  Plot plot;
  plot.title = "Curvature along the line";
  plot.subtitle = "a test of everything the plot can hold";
  plot.x.title = "Arc length [mm]";
  plot.y.title = "Curvature [1/mm]";
  Series wave{.name = "wave", .color = palette(0)};
  Series dots{.name = "dots", .kind = SeriesKind::points, .color = palette(1)};
  for (int i = 0; i <= 400; ++i) {
    wave.points.push_back({i * 0.25, 1e-4 * std::sin(i * 0.05)});
    if (i % 20 == 0) dots.points.push_back(wave.points.back());
  }
  plot.series = {wave, dots};
  plot.rules = {{0, false, kFrame, {}, ""}, {30, true, kFrame, {3, 3}, "joint"}};
  plot.bands = {{0, 30, "1", true}, {30, 32, "2", false}, {32, 100, "3", true}};
  plot.notes = {{{31, 1e-4}, "crest"}, {{31.5, 1e-4}, "crest again"}};
  return plot;
}

TEST(Plot, DrawsTheSameThingEveryTime) {
  const Drawing a = draw(sample_plot());
  EXPECT_EQ(write_svg(a), write_svg(draw(sample_plot())));
  EXPECT_EQ(a.width, 720);
  const auto png = write_png(a, 1);
  ASSERT_TRUE(png);
  EXPECT_GT(Decoded(*png).count_other_than(0xFFFFFFU), 4000);
}

TEST(Plot, StatesTheCommonPowerOfTen) {
  const std::string svg = write_svg(draw(sample_plot()));
  EXPECT_NE(svg.find("Curvature [1/mm] ×10⁻⁶"), std::string::npos);
  EXPECT_NE(svg.find("Arc length [mm]</text>"), std::string::npos);
}

TEST(Plot, KeepsLinesInsideTheFrame) {
  Plot plot = sample_plot();
  plot.series[0].points.push_back({50, 1e300});
  plot.series[0].points.push_back({60, -1e300});
  plot.y.low = -1e-4;
  plot.y.high = 1e-4;
  const Drawing d = draw(plot);
  for (const Item& item : d.items)
    if (const auto* shape = std::get_if<Shape>(&item.value))
      for (const PathStep& step : shape->path.steps) {
        EXPECT_GE(step.point[2].y, -1);
        EXPECT_LE(step.point[2].y, d.height + 1);
      }
}

TEST(Plot, StandsEmptyAndHostileInput) {
  EXPECT_TRUE(write_png(draw(Plot{})));
  Plot plot;
  plot.x.scale = plot.y.scale = Scale::log10;
  plot.series = {{.name = "bad", .points = {{NAN, 1}, {-1, 2}, {0, 0}, {INFINITY, 5}}}};
  EXPECT_TRUE(write_png(draw(plot)));
  plot.series[0].points = {{1e-300, 1e300}, {1e300, 1e-300}};
  EXPECT_TRUE(write_svg(draw(plot)).size() > 100);
  plot.x.scale = plot.y.scale = Scale::linear;
  plot.series[0].points = {{-1.7e308, 1e308}, {1.7e308, 1}, {3, 3}};
  EXPECT_TRUE(write_svg(draw(plot)).size() > 100);
  plot.title = std::string(5000, 'W');
  EXPECT_LT(write_svg(draw(plot)).size(), 30000U);
  plot.width = 1;
  EXPECT_THROW(draw(plot), core::InvalidInput);
}

}  // namespace
}  // namespace keyline::figure
