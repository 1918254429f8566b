#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "keyline/sketch/background.h"
#include "keyline/sketch/trace.h"

#include "page.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using testing::blank_page;
using testing::draw_line;

/// Light that is left beyond a hard edge through a place, of the given direction.
double light(Point2 p, double direction, double left) {
  const double beyond = (p.x - 200) * std::sin(direction) - (p.y - 150) * std::cos(direction) + 0.5;
  return 1 - (1 - left) * std::clamp(beyond, 0.0, 1.0);
}

// Paper in light and in shade is as white on either side of the edge, up to it and up to the rim; a
// broad patch of ink beside the edge stays as dark as it is.
TEST(ShadowEdge, PaperIsWhiteUpToIt) {
  Raster<std::uint16_t> level(400, 300);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 400; ++x) {
      const bool ink = x >= 230 && x < 270 && y >= 60 && y < 100;
      const double paper = light({x + 0.5, y + 0.5}, 1.3, 0.8);
      level.at(x, y) = static_cast<std::uint16_t>(ink ? 15000 : Tone::kWhite * paper);
    }
  ASSERT_TRUE(flatten_background(level, 0.18, Flatten::automatic));
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 400; ++x) {
      const bool ink = x >= 230 && x < 270 && y >= 60 && y < 100;
      const bool beside = x >= 213 && x < 287 && y >= 43 && y < 117;  // half a block around it
      if (ink) {
        EXPECT_LT(level.at(x, y), 0.5 * Tone::kWhite) << x << ' ' << y;
      } else if (!beside) {
        EXPECT_NEAR(level.at(x, y), Tone::kWhite, 0.02 * Tone::kWhite) << x << ' ' << y;
      }
    }
}

// Drawn on paper half of which lies in a hard shadow: as many lines as were drawn, and none of the
// shadow's ink is missed.
TEST(ShadowEdge, IsNoLineAndNoLostInk) {
  for (const double direction : {0.4, 1.9, 2.8}) {
    SCOPED_TRACE(direction);
    Image page = blank_page(400, 300);
    draw_line(page, {40, 60}, {360, 40}, 3, 0.9);
    draw_line(page, {60, 110}, {340, 230}, 3, 0.9);
    draw_line(page, {50, 270}, {350, 255}, 3, 0.9);
    std::minstd_rand random(11);
    std::normal_distribution<double> grain(0, 0.01);
    for (int y = 0; y < 300; ++y)
      for (int x = 0; x < 400; ++x) {
        std::uint16_t& v = page.luminance.at(x, y);
        v = static_cast<std::uint16_t>(std::clamp(
            0.95 * v * (light({x + 0.5, y + 0.5}, direction, 0.6) + grain(random)), 0.0, 65535.0));
      }
    const auto result = trace(page);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->strokes.size(), 3U);
    EXPECT_GT(result->explained, 0.99);
  }
}

}  // namespace
}  // namespace keyline::sketch
