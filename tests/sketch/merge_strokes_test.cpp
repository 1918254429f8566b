#include "keyline/sketch/merge_strokes.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

namespace keyline::sketch {
namespace {

using core::Point2;

FineStroke stroke(const std::vector<Point2>& points, std::size_t number) {
  FineStroke fine;
  fine.points = points;
  fine.widths.assign(points.size(), 2.0);
  fine.width = 2;
  fine.members = {number};
  return fine;
}

std::vector<Point2> straight(double y, int to) {
  std::vector<Point2> points;
  for (int x = 0; x <= to; ++x) points.push_back({1.0 * x, y});
  return points;
}

const ConsolidateOptions kTwoWide{.width = 2, .measured = true, .apart = 4, .hand = 0};

TEST(MergeStrokes, TellsPassesFromStrokesAlone) {
  std::vector<FineStroke> strokes{stroke(straight(0, 200), 0), stroke(straight(3, 200), 1),
                                  stroke(straight(80, 200), 2)};
  std::vector<std::string> notes;
  const Merged merged = merge(strokes, 2, kTwoWide, {}, notes);
  EXPECT_EQ(strokes.size(), 2U);
  EXPECT_EQ(merged.passes.size(), 2U);
  EXPECT_NEAR(merged.beside, 1, 0.01);
  EXPECT_NEAR(merged.explained, 600, 6);
}

// Two strokes are passes of one line for 140 of 200; then one goes away at right angles.
TEST(MergeStrokes, CountsPassesAsFarAsTheyRunBesideTheirLine) {
  std::vector<Point2> leaves = straight(3, 140);
  for (int i = 1; i <= 60; ++i) leaves.push_back({140.0, 3.0 + i});
  std::vector<FineStroke> strokes{stroke(straight(0, 200), 0), stroke(straight(1, 200), 1),
                                  stroke(leaves, 2)};
  std::vector<std::string> notes;
  const Merged merged = merge(strokes, 2, kTwoWide, {}, notes);
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_LT(merged.beside, 0.95);
  EXPECT_GT(merged.beside, 0.85);
}

/// Black lines on white, three pixels wide, at these heights.
Image drawn_at(const std::vector<int>& heights) {
  Image image;
  image.luminance = Raster<std::uint16_t>(260, 120, 65535);
  for (const int y : heights)
    for (int x = 20; x < 240; ++x)
      for (int v = y - 1; v <= y + 1; ++v) image.luminance.at(x, v) = 0;
  return image;
}

// Ink of passes beside their line is explained: there is nothing to warn of.
TEST(MergeStrokes, InkOfPassesIsExplained) {
  TraceOptions options;
  options.consolidate = true;
  const auto result = trace(drawn_at({40, 48, 56, 90}), options);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->strokes.size(), 2U);
  EXPECT_GT(result->explained, 0.99);
  for (const std::string& note : result->notes)
    EXPECT_EQ(note.find("explain"), std::string::npos) << note;
}

}  // namespace
}  // namespace keyline::sketch
