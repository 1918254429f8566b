#include "keyline/sketch/bridge_gaps.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

#include "page.h"

namespace keyline::sketch {
namespace {

using testing::blank_page;
using testing::draw_line;

// A gap is what one sees: from ink to ink.
TEST(BridgeGaps, FromInkToInk) {
  Image page = blank_page(400, 60);
  for (int k = 0; k < 12; ++k)  // dashes of 20 pixels, round ends included, with gaps of 10
    draw_line(page, {22.0 + 30 * k, 30}, {38.0 + 30 * k, 30}, 4);
  for (const auto& [gap, strokes] : {std::pair{std::optional<double>(7), 12U},
                                     {std::optional<double>(12), 1U},
                                     {std::optional<double>(), 1U}}) {
    TraceOptions options;
    options.gap = gap;
    const auto result = trace(page, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->strokes.size(), strokes) << "gap " << gap.value_or(-1);
  }
}

// What lies under other ink is no gap: pale lines, whose ink stops beside a dark one's, go on
// across it, and so does one that stops short of a broad one. Paper of more than the gap does not.
TEST(BridgeGaps, OtherInkIsNoGap) {
  Image pale = blank_page(200, 120);
  for (const double y : {25, 50, 75}) draw_line(pale, {10, y}, {190, y + 8}, 1.6, 0.35);
  draw_line(pale, {90, 10}, {100, 110}, 4);
  const auto crossed = trace(pale);
  ASSERT_TRUE(crossed) << crossed.error().message;
  EXPECT_EQ(crossed->strokes.size(), 4U);
  for (const auto& [paper, strokes] : {std::pair{4, 2U}, {7, 3U}}) {
    Image page = blank_page(200, 120);
    draw_line(page, {100, 8}, {100, 112}, 12);
    draw_line(page, {10, 60}, {92.5 - paper, 60}, 3);
    draw_line(page, {107.5 + paper, 60}, {190, 60}, 3);
    TraceOptions options;
    options.gap = 10;
    const auto result = trace(page, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->strokes.size(), strokes) << paper << " pixels of paper on either side";
  }
}

// A line that touches another on one side and comes out of it after a gap on the other, as a row of
// dashes may, is one; where it would have to turn it ends there.
TEST(BridgeGaps, ATouchingEndGoesOnStraightBehindTheLine) {
  for (const auto& [turn, strokes] : {std::pair{0.0, 2U}, {0.6, 3U}}) {
    Image page = blank_page(200, 120);
    draw_line(page, {100, 8}, {100, 112}, 12);
    draw_line(page, {10, 60}, {100, 60}, 3);
    draw_line(page, {113.5, 60}, {113.5 + 75 * std::cos(turn), 60 + 75 * std::sin(turn)}, 3);
    TraceOptions options;
    options.gap = 12;
    const auto result = trace(page, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->strokes.size(), strokes) << "turned by " << turn;
  }
}

// A line between two gaps as long is a dash where it is no longer than long dashes are; windows on
// both sides of a pillar are none. No gap of a row is much longer than 18 widths: strokes farther
// apart are no row, however even.
TEST(BridgeGaps, LongLinesAndFarOnesAreNoRowOfDashes) {
  struct Row {
    int dash, gap;
    unsigned strokes;
  };
  for (const auto& [dash, gap, strokes] :
       {Row{60, 16, 1}, {150, 16, 1}, {320, 16, 3}, {60, 54, 1}, {60, 108, 3}}) {
    const double next = dash + gap;
    Image page = blank_page(3 * dash + 2 * gap + 28, 40);
    for (int k = 0; k < 3; ++k)
      draw_line(page, {12 + next * k, 20}, {12 + next * k + dash - 3, 20}, 3);
    const auto result = trace(page);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->strokes.size(), strokes) << dash << ' ' << gap;
  }
}

// Dashes are a row by the paper between them: strokes that face each other across other lines are
// none, and a row goes on over a line that it crosses.
TEST(BridgeGaps, OtherInkInEveryGapIsNoRowOfDashes) {
  struct Case {
    std::vector<int> lines;  ///< gaps with a line across
    unsigned strokes;
  };
  for (const Case& one : {Case{{}, 1}, {{1}, 2}, {{0, 1, 2}, 7}, {{2}, 3}}) {
    Image page = blank_page(280, 100);
    for (int k = 0; k < 4; ++k) draw_line(page, {22.0 + 65 * k, 50}, {51.0 + 65 * k, 50}, 3);
    for (const int k : one.lines) draw_line(page, {69.0 + 65 * k, 12}, {69.0 + 65 * k, 88}, 3);
    const auto result = trace(page);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->strokes.size(), one.strokes) << one.lines.size();
  }
}

// The pixels at the end of a short dash tell its direction badly, those of all of it well: a row
// along an arc is one line in whatever direction it goes.
TEST(BridgeGaps, ShortDashesGoOnInAnyDirection) {
  for (int k = 0; k < 4; ++k) {
    const double start = 0.39 * k;
    const double radius = 150;
    const auto at = [&](double way) {
      const double turn = start + way / radius;
      return core::Point2{40 + radius * (std::sin(turn) - std::sin(start)),
                          40 + radius * (std::cos(start) - std::cos(turn))};
    };
    Image page = blank_page(230, 230);
    for (double way = 0; way < 170; way += 32) {
      draw_line(page, at(way), at(way + 9), 2);
      draw_line(page, at(way + 9), at(way + 18), 2);
    }
    const auto result = trace(page);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->strokes.size(), 1U) << "first direction " << start;
  }
}

}  // namespace
}  // namespace keyline::sketch
