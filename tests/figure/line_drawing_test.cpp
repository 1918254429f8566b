#include "keyline/figure/line_drawing.h"

#include <pugixml.hpp>

#include <gtest/gtest.h>

namespace keyline::figure {
namespace {

std::vector<double> stroke_widths(const Drawing& drawing) {
  pugi::xml_document document;
  const std::string svg = write_svg(drawing);
  EXPECT_TRUE(document.load_buffer(svg.data(), svg.size()));
  std::vector<double> widths;
  for (const auto& found : document.select_nodes("//*[local-name()='path'][@stroke-width]"))
    widths.push_back(found.node().attribute("stroke-width").as_double());
  return widths;
}

TEST(LineDrawing, ShowsWidthsTrueToScale) {
  // 676 px across (720 less the sides) stand for 100 mm
  const std::vector<DrawnLine> lines = {{{{0, 0}, {100, 0}, {100, 20}}, 1},
                                        {{{0, 5}, {50, 5}}, 1e-4},
                                        {{{0, 9}, {50, 9}}, 50},
                                        {{{0, 12}, {50, 12}}, 0}};
  const auto widths = stroke_widths(line_drawing(lines, "", {.unit = "mm"}));
  ASSERT_GE(widths.size(), 4U);
  EXPECT_NEAR(widths[0], 6.76, 0.02);
  EXPECT_NEAR(widths[1], 0.8, 1e-9);
  EXPECT_NEAR(widths[2], 12, 1e-9);
  EXPECT_NEAR(widths[3], 1.4, 1e-9);
}

TEST(LineDrawing, StandsWithoutLines) {
  EXPECT_TRUE(write_png(line_drawing({})));
  EXPECT_TRUE(write_png(line_drawing({{{{3, 3}}}})));
}

}  // namespace
}  // namespace keyline::figure
