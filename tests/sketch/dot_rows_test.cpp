#include "keyline/sketch/dot_rows.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

#include "page.h"

namespace keyline::sketch {
namespace {

using core::Point2;

void draw_dot(Image& page, Point2 at, double width) {
  testing::draw_line(page, at, {at.x + 1e-3, at.y}, width);
}

/// On an arc of radius 110 that starts at a place.
Point2 along_arc(Point2 start, double way) {
  const double turn = 0.3 + way / 110;
  return {start.x + 110 * (std::sin(turn) - std::sin(0.3)),
          start.y + 110 * (std::cos(0.3) - std::cos(turn))};
}

/// How far the two ends of a line are from two places; y of the line up.
double off_ends(const Stroke& line, Point2 a, Point2 b, int high) {
  const Point2 from = line.points.front();
  const Point2 to = line.points.back();
  a.y = high - a.y;
  b.y = high - b.y;
  return std::min(std::max(core::distance(from, a), core::distance(to, b)),
                  std::max(core::distance(from, b), core::distance(to, a)));
}

// Five dots and more at an even pitch are a line from the first to the last; four are dirt.
TEST(DotRows, FiveDotsInARowAreALine) {
  for (const int count : {4, 5}) {
    SCOPED_TRACE(count);
    Image page = testing::blank_page(170, 130);
    testing::draw_line(page, {10, 120}, {160, 120}, 3);
    for (int k = 0; k < count; ++k) draw_dot(page, along_arc({20, 20}, 11 * k), 4);
    const auto result = trace(page);
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(result->strokes.size(), count < 5 ? 1U : 2U);
    if (count < 5) continue;
    const Point2 last = along_arc({20, 20}, 11 * (count - 1));
    const Stroke& row = result->strokes[1];  // the shorter
    EXPECT_LT(off_ends(row, {20, 20}, last, page.height()), 1);
    EXPECT_GT(result->explained, 0.99);
    EXPECT_TRUE(result->notes.empty()) << result->notes.front();
  }
}

// A picture of dots alone was refused: nothing in it looked like a line.
TEST(DotRows, APictureOfOneDottedLine) {
  for (const double width : {2.2, 7.0}) {
    Image page = testing::blank_page(170, 130);
    for (int k = 0; k < 7; ++k) draw_dot(page, along_arc({20, 20}, 2.2 * width * k), width);
    const auto result = trace(page);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->strokes.size(), 1U) << "width " << width;
  }
}

// A chain line ends where it is drawn to, though its last dots are as small as dirt.
TEST(DotRows, AChainLineKeepsTheDotsAtItsEnds) {
  Image page = testing::blank_page(200, 140);
  const Point2 start{20, 20};
  for (int k = 0; k < 4; ++k) {
    const double way = 50.0 * k;
    draw_dot(page, along_arc(start, way), 3);
    if (k == 3) break;
    for (int i = 0; i < 4; ++i)
      testing::draw_line(page, along_arc(start, way + 11 + 7 * i),
                         along_arc(start, way + 18 + 7 * i), 3);
  }
  const auto result = trace(page);
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->strokes.size(), 1U);
  EXPECT_LT(off_ends(result->strokes[0], start, along_arc(start, 150), page.height()), 1.5);
  EXPECT_TRUE(result->notes.empty()) << result->notes.front();
}

// A screen's dots have others beside them as near as before and behind: they are shade.
TEST(DotRows, AScreenIsNoLine) {
  Image page = testing::blank_page(120, 120);
  testing::draw_line(page, {10, 110}, {110, 110}, 3);
  for (int i = 0; i < 7; ++i)
    for (int k = 0; k < 6; ++k)
      draw_dot(page, {20.0 + 11 * i + 2 * k, 15.0 + 11 * k - 2 * i + 18}, 4);
  const auto result = trace(page);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->strokes.size(), 1U);
}

}  // namespace
}  // namespace keyline::sketch
