#include "keyline/sketch/lone_passes.h"

#include <gtest/gtest.h>

#include "keyline/sketch/consolidate.h"

namespace keyline::sketch {
namespace {

DrawnStroke straight(double y, double from, double to) {
  DrawnStroke stroke;
  for (double x = from; x <= to; x += 2) stroke.points.push_back({x, y});
  return stroke;
}

const ConsolidateOptions kPen{.width = 2, .measured = true};

/// A line of four passes a tenth of a pen apart, which shows how little the hand errs.
std::vector<DrawnStroke> careful() {
  return {straight(0, 0, 400), straight(0.2, 0, 400), straight(0.4, 0, 400), straight(0.6, 0, 400)};
}

TEST(LonePasses, ArePassesOfTheLineTheyRunAlong) {
  std::vector<DrawnStroke> strokes = careful();
  strokes.push_back(straight(2.8, 150, 250));  // 1.25 pens from the line
  const auto lines = consolidate(strokes, kPen);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].members, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_NEAR(lines[0].explained, 1700, 20);
}

TEST(LonePasses, StayLinesFartherOffOrOnTheirWayElsewhere) {
  std::vector<DrawnStroke> strokes = careful();
  strokes.push_back(straight(4, 150, 250));  // 1.85 pens
  EXPECT_EQ(consolidate(strokes, kPen).size(), 2U);
  strokes.back() = straight(2.8, 340, 440);  // beside it for six tenths
  EXPECT_EQ(consolidate(strokes, kPen).size(), 2U);
  strokes.back() = {{{200, -1}, {200, 1.6}}, false};  // across, not along
  EXPECT_EQ(consolidate(strokes, kPen).size(), 2U);
}

TEST(LonePasses, StayLinesBesideStrokesAloneAndWhereKept) {
  std::vector<DrawnStroke> strokes = careful();
  strokes.push_back(straight(50, 0, 300));
  strokes.push_back(straight(52.6, 0, 300));  // two lines 1.3 pens apart, drawn once each
  EXPECT_EQ(consolidate(strokes, kPen).size(), 3U);
  strokes = careful();
  strokes.push_back(straight(2.8, 150, 250));
  ConsolidateOptions keeping = kPen;
  keeping.wishes.keep = {4};
  EXPECT_EQ(consolidate(strokes, keeping).size(), 2U);
}

}  // namespace
}  // namespace keyline::sketch
