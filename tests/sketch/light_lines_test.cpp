#include "keyline/sketch/light_lines.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "keyline/core/polygon.h"
#include "keyline/sketch/trace.h"

#include "page.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using testing::blank_page;
using testing::draw_line;

/// A transparent sheet as the reader gives it, laid over both grounds.
struct Sheet {
  Image image = blank_page(300, 220);
  Sheet() { image.over_black = blank_page(300, 220, 0).luminance; }

  /// A stroke of that colour (0 black … 1 white), soft at its edges.
  void draw(Point2 from, Point2 to, double width, double colour) {
    Image cover = blank_page(300, 220);
    draw_line(cover, from, to, width, 1);
    for (auto* ground : {&image.luminance, &image.over_black})
      for (std::size_t i = 0; i < ground->data.size(); ++i) {
        const double rest = cover.luminance.data[i] / 65535.0;
        ground->data[i] =
            static_cast<std::uint16_t>(rest * ground->data[i] + (1 - rest) * colour * 65535);
      }
  }
};

bool tells(const TraceResult& result, const std::string& what) {
  return std::ranges::any_of(
      result.notes, [&](const std::string& note) { return note.find(what) != std::string::npos; });
}

// Three lines of 240 pixels, one of them black, that cross a fourth.
TEST(LightLines, AreTracedAmongDarkOnes) {
  Sheet sheet;
  sheet.draw({150, 20}, {150, 200}, 4, 0);
  sheet.draw({30, 50}, {270, 60}, 4, 1);
  sheet.draw({30, 110}, {270, 100}, 4, 0);
  sheet.draw({30, 160}, {270, 170}, 4, 0.8);
  const auto result = trace(sheet.image);
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->strokes.size(), 4U);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(core::polygon_length(result->strokes[k].points), std::hypot(240, 10), 3);
  EXPECT_TRUE(tells(*result, "54 % of what is drawn on the transparent ground is light lines"))
      << result->notes.front();
}

TEST(LightLines, OneKindCanBeAskedFor) {
  Sheet sheet;
  sheet.draw({30, 50}, {270, 60}, 4, 1);
  sheet.draw({30, 110}, {200, 100}, 4, 0);
  for (const auto& [wanted, length] : {std::pair{Polarity::dark_on_light, std::hypot(170, 10)},
                                       {Polarity::light_on_dark, std::hypot(240, 10)}}) {
    TraceOptions options;
    options.tone.polarity = wanted;
    const auto result = trace(sheet.image, options);
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(result->strokes.size(), 1U);
    EXPECT_NEAR(core::polygon_length(result->strokes[0].points), length, 3);
  }
}

// A sticker: white within dark outlines and around them, a white rim beside a line.
TEST(LightLines, AreasAndRimsArePaper) {
  Sheet sheet;
  sheet.draw({60, 60}, {130, 60}, 60, 1);
  sheet.draw({60, 45}, {130, 75}, 4, 0);
  sheet.draw({60, 75}, {130, 45}, 4, 0);
  sheet.draw({40, 160}, {260, 170}, 10, 1);
  sheet.draw({40, 160}, {260, 170}, 4, 0);
  const auto result = trace(sheet.image);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->strokes.size(), 3U);
  EXPECT_FALSE(tells(*result, "light lines"));
  EXPECT_TRUE(tells(*result, "light areas or rims of dark lines: left out"));
}

// A line is as wide as twice its area for each side of its border: of 20 by 150 pixels 17.6, of 24
// by 150 20.7. A share of 0.06 of the larger side, here 18, is broad.
TEST(LightLines, AreNarrowByTheirAreaAndBorder) {
  for (const int width : {20, 24}) {
    Sheet sheet;
    for (int y = 30; y < 180; ++y)
      for (int x = 40; x < 40 + width; ++x) sheet.image.over_black.at(x, y) = 65535;
    const LightShare light = darken_light_lines(sheet.image, Polarity::automatic);
    EXPECT_EQ(light.lines, width == 20 ? 1 : 0);
    EXPECT_EQ(light.rest, width == 20 ? 0 : 1);
    EXPECT_EQ(sheet.image.luminance.at(45, 100), width == 20 ? 0 : 65535);
  }
}

}  // namespace
}  // namespace keyline::sketch
