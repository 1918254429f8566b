#include "keyline/sketch/faint_ink.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

#include "page.h"

namespace keyline::sketch {
namespace {

using testing::blank_page;
using testing::draw_line;

bool warns(const TraceResult& result) {
  return std::ranges::any_of(result.notes, [](const std::string& note) {
    return note.starts_with("warning: the lines explain");
  });
}

// Pencil of an eighth of the paper's light beside and across ink: too faint to become a line
// there, so it has to be missed.
TEST(FaintInk, IsMissedWhereItIsLost) {
  for (const double beside : {8.0, 12.0, 40.0}) {
    SCOPED_TRACE(beside);
    Image page = blank_page(400, 300);
    draw_line(page, {40, 100}, {360, 140}, 4, 0.125);
    draw_line(page, {40, 100 + beside}, {360, 140 + beside}, 4, 0.95);
    const auto result = trace(page);
    ASSERT_TRUE(result);
    if (result->strokes.size() == 1) {
      // half of what was drawn, less the pencil's soft border and what is next to the ink
      EXPECT_NEAR(result->explained, 0.5, 0.15);
      EXPECT_TRUE(warns(*result));
    } else {
      EXPECT_GT(result->explained, 0.97);
    }
  }
}

TEST(FaintInk, IsNotSeenInTheBordersOfLines) {
  for (const double width : {1.0, 2.0, 5.0, 12.0, 20.0}) {
    SCOPED_TRACE(width);
    Image page = blank_page(400, 300);
    draw_line(page, {40, 100}, {360, 140}, width);
    const auto sharp = trace(page);
    ASSERT_TRUE(sharp);
    EXPECT_GT(sharp->explained, 0.99);
    Image soft = page;  // out of focus
    const int reach = static_cast<int>(0.5 * width);
    for (int y = 0; y < page.height(); ++y)
      for (int x = 0; x < page.width(); ++x) {
        double sum = 0;
        int count = 0;
        for (int v = std::max(0, y - reach); v <= std::min(page.height() - 1, y + reach); ++v) {
          sum += page.luminance.at(x, v);
          ++count;
        }
        soft.luminance.at(x, y) = static_cast<std::uint16_t>(sum / count);
      }
    const auto blurred = trace(soft);
    ASSERT_TRUE(blurred);
    EXPECT_FALSE(warns(*blurred)) << blurred->explained;
  }
}

TEST(FaintInk, IsCountedByPieces) {
  Binary ink(40, 30);
  for (int x = 0; x < 40; ++x) ink.at(x, 10) = 1;
  FaintPixels faint(40, 30);
  Tone tone = transform_intensity(blank_page(40, 30));
  const auto fill = [&](int y, int from, int to) {
    for (int x = from; x < to; ++x) {
      faint.set(x, y);
      tone.level.at(x, y) = static_cast<std::uint16_t>(0.9 * tone.level.at(x, y));
    }
  };
  fill(11, 0, 40);  // the ink's border
  fill(13, 0, 40);
  fill(20, 3, 17);  // 14 pixels, and 6 more across a corner
  fill(21, 17, 23);
  fill(25, 30, 37);  // 7
  FaintPixels again = faint;
  const Binary as_it_was = ink;
  EXPECT_EQ(count_lost(faint, ink, tone, {.reach = 3, .specks = 8, .broadest = 4}), 20U);
  EXPECT_EQ(count_lost(again, ink, tone, {.reach = 2.5, .specks = 1, .broadest = 4}), 67U);
  EXPECT_EQ(ink.data, as_it_was.data);
}

TEST(FaintInk, BecomesLinesWhereItIsNarrow) {
  Binary ink(60, 40);
  for (int x = 0; x < 60; ++x) ink.at(x, 5) = 1;
  FaintPixels faint(60, 40);
  Tone tone = transform_intensity(blank_page(60, 40));
  const auto is = [&](int x, int y, double darker) {
    faint.set(x, y);
    tone.level.at(x, y) = static_cast<std::uint16_t>(tone.level.at(x, y) * (1 - darker));
  };
  for (int x = 5; x < 55; ++x)
    for (const int y : {7, 15, 16}) is(x, y, 0.1);  // a border, and a line
  for (int y = 24; y < 36; ++y)
    for (int x = 10; x < 22; ++x) is(x, y, 0.1);  // a smudge
  const FaintLine line{.reach = 3, .specks = 20, .broadest = 4};
  FaintPixels shaded = faint;
  FaintPixels edge = faint;
  Binary again = ink;
  EXPECT_EQ(ink_lines(faint, ink, tone, line), 100U);
  EXPECT_EQ(std::count(ink.data.begin(), ink.data.end(), 1), 160);
  EXPECT_EQ(ink.at(30, 15), 1);
  EXPECT_EQ(count_lost(faint, ink, tone, line), 144U) << "the smudge is left to be told";
  const auto shade = [&](int from, int to) {
    for (int y = from; y < to; ++y)
      for (int x = 0; x < 60; ++x)
        tone.level.at(x, y) = static_cast<std::uint16_t>(tone.level.at(x, y) * 0.93);
  };
  shade(17, 24);  // hardly lighter than the line: it is the shade's edge
  EXPECT_EQ(ink_lines(edge, again, tone, line), 0U);
  shade(8, 15);  // on the other side, too
  EXPECT_EQ(ink_lines(shaded, again, tone, line), 0U);
}

// What thresholds took for ink at a shadow's border has the shadow on one side.
TEST(FaintInk, OfShadesEdgeIsDropped) {
  Binary ink(60, 40);
  Tone tone = transform_intensity(blank_page(60, 40));
  const auto fill = [&](int from, int to, int left, int right, double darker, bool is_ink) {
    for (int y = from; y < to; ++y)
      for (int x = left; x < right; ++x) {
        ink.at(x, y) = is_ink ? 1 : 0;
        tone.level.at(x, y) = static_cast<std::uint16_t>(tone.level.at(x, y) * (1 - darker));
      }
  };
  fill(4, 6, 5, 55, 0.5, true);     // a line
  fill(26, 38, 40, 52, 0.5, true);  // a blot
  fill(15, 17, 5, 35, 0.1, true);   // pencil, or the edge of what follows
  Binary pencil = ink;
  EXPECT_EQ(drop_shade(pencil, tone, 4), 0U);
  EXPECT_EQ(pencil.data, ink.data);
  fill(17, 38, 5, 35, 0.07, false);
  EXPECT_EQ(drop_shade(ink, tone, 4), 60U);
  EXPECT_EQ(std::count(ink.data.begin(), ink.data.end(), 1), 100 + 144);
  EXPECT_EQ(ink.at(30, 15), 0);
}

// A shadow that fades over half the page has no border: it is not missed as ink. One that ends
// within two pixels might be drawn, and is.
TEST(FaintInk, IsNoShadeThatFades) {
  for (const double over : {200.0, 2.0}) {
    SCOPED_TRACE(over);
    Image page = blank_page(400, 300);
    draw_line(page, {40, 60}, {360, 40}, 4, 0.9);
    std::minstd_rand random(7);
    std::normal_distribution<double> grain(0, 0.008);
    for (int y = 0; y < 300; ++y)
      for (int x = 0; x < 400; ++x) {
        const double shadow = 0.1 * std::clamp((x - 150) / over, 0.0, 1.0);
        std::uint16_t& v = page.luminance.at(x, y);
        v = static_cast<std::uint16_t>(
            std::clamp(v * (0.98 - shadow + grain(random)), 0.0, 65535.0));
      }
    TraceOptions as_it_is;
    as_it_is.tone.flatten = Flatten::off;
    const auto result = trace(page, as_it_is);
    ASSERT_TRUE(result);
    EXPECT_EQ(warns(*result), over < 10) << result->explained;
  }
}

// Blue pencil, an eighth as dark as the paper is light, that crosses one ink line and lies between
// others: their thresholds would lose it.
TEST(FaintInk, OfBluePencilIsTraced) {
  Image page = blank_page(400, 300);
  draw_line(page, {180, 55}, {225, 250}, 4, 0.125);
  draw_line(page, {40, 150}, {360, 140}, 3, 0.95);
  draw_line(page, {40, 40}, {360, 40}, 3, 0.95);
  draw_line(page, {40, 270}, {360, 270}, 3, 0.95);
  const auto result = trace(page);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->strokes.size(), 4U);
  EXPECT_GT(result->explained, 0.98);
  const auto& pencil = result->strokes.back().points;  // straight through the crossing
  EXPECT_NEAR(core::distance(pencil.front(), pencil.back()), std::hypot(45, 195), 4);
}

/// A pale level line across the page from x = 60 to 260, crossed by dark ones; how far the traced
/// one strays from it, or nothing unless each line comes as one.
std::optional<double> stray_of_pale(double width, double dark_width, double degrees, int count) {
  Image page = blank_page(320, 240);
  draw_line(page, {60, 120}, {260, 120}, width, 0.3);
  const double angle = degrees * std::numbers::pi / 180;
  const core::Vector2 half = 45 * core::Vector2{std::cos(angle), std::sin(angle)};
  for (int k = 1; k <= count; ++k) {
    const core::Point2 middle{60 + 200.0 * k / (count + 1), 120};
    draw_line(page, middle - half, middle + half, dark_width, 0.9);
  }
  const auto result = trace(page);
  if (!result || result->strokes.size() != static_cast<std::size_t>(count) + 1) return {};
  const auto& pale = result->strokes.front().points;
  if (std::abs(core::distance(pale.front(), pale.back()) - 200) > width) return {};
  double stray = 0;
  for (const core::Point2 p : pale) stray = std::max(stray, std::abs(p.y - 120));
  return stray;
}

// Its pieces were cut off three pixels beside the dark lines and left out, some as dirt.
TEST(FaintInk, OfPaleLinesGoesThroughBroadDarkOnes) {
  for (const double width : {3.0, 5.0}) {
    SCOPED_TRACE(width);
    const auto stray = stray_of_pale(width, 8, 55, 4);
    ASSERT_TRUE(stray);
    EXPECT_LT(*stray, 0.5 * width) << "off its ink";
  }
}

// Beside thin dark lines the middle of a broad pale one was read off these.
TEST(FaintInk, OfBroadPaleLinesIsNotReadOffThinDarkOnes) {
  for (const double degrees : {35.0, 42.0, 60.0}) {
    SCOPED_TRACE(degrees);
    const auto stray = stray_of_pale(5.4, 2.4, degrees, 3);
    ASSERT_TRUE(stray);
    EXPECT_LT(*stray, 2.7) << "off its ink";
  }
}

}  // namespace
}  // namespace keyline::sketch
