#include "keyline/sketch/merge_strokes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

#include "page.h"

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
  std::vector<FineStroke> strokes{stroke(straight(0, 200), 0), stroke(straight(2.8, 200), 1),
                                  stroke(straight(80, 200), 2)};
  std::vector<std::string> notes;
  const Merged merged = merge(strokes, 2, kTwoWide, {}, notes);
  EXPECT_EQ(strokes.size(), 2U);
  EXPECT_EQ(merged.passes.size(), 2U);
  EXPECT_NEAR(merged.explained, 600, 6);
}

// A second stroke leaves the first by 1 to 6.5 pens, ever farther to one side: what of it lies more
// than a pen and a half from their line is not explained by it.
TEST(MergeStrokes, LeavesPassesOutThatLieFarFromTheirLine) {
  std::vector<Point2> leaves;
  for (int x = 0; x <= 200; ++x) leaves.push_back({1.0 * x, 2 + 11 * std::pow(x / 200.0, 4)});
  std::vector<FineStroke> strokes{stroke(straight(0, 200), 0), stroke(leaves, 1)};
  std::vector<std::string> notes;
  const Merged merged = merge(strokes, 2, kTwoWide, {}, notes);
  ASSERT_EQ(strokes.size(), 1U);
  ASSERT_EQ(merged.passes.size(), 2U);
  std::size_t left = 0;
  for (const FineStroke& pass : merged.passes)
    for (const Point2 p : pass.points) {
      double least = 1e9;
      for (const Point2 q : strokes[0].points) least = std::min(least, core::distance(p, q));
      EXPECT_LT(least, 3.1);
      ++left;
    }
  EXPECT_GT(left, 300U);
  EXPECT_LT(left, 395U);
  ASSERT_EQ(merged.far.size(), 2U);
  EXPECT_EQ(left + merged.far[0].points.size() + merged.far[1].points.size(), 402U);
}

/// Of a picture with lines of three pixels from left to right, at these heights there.
core::Result<TraceResult> consolidated(const std::vector<std::pair<double, double>>& heights) {
  Image image = testing::blank_page(260, 120);
  for (const auto& [left, right] : heights) testing::draw_line(image, {20, left}, {240, right}, 3);
  TraceOptions options;
  options.consolidate = true;
  return trace(std::move(image), options);
}

// Ink of passes beside their line is explained: there is nothing to warn of.
TEST(MergeStrokes, InkOfPassesIsExplained) {
  const auto result = consolidated({{40, 40}, {43.5, 47.5}, {90, 90}});
  ASSERT_TRUE(result);
  ASSERT_EQ(result->strokes.size(), 2U);
  EXPECT_GT(result->explained, 0.99);
  for (const std::string& note : result->notes)
    EXPECT_EQ(note.find("explain"), std::string::npos) << note;
}

// Three lines that touch at the left and fan out to 2.7 pens from each other: what lies beyond a
// pen and a half is told.
TEST(MergeStrokes, TellsPassesThatLieFarFromTheirLine) {
  const auto result = consolidated({{40, 36}, {44, 44}, {48, 52}});
  ASSERT_TRUE(result);
  ASSERT_EQ(result->strokes.size(), 1U);
  EXPECT_LT(result->explained, 0.9);
  EXPECT_TRUE(std::ranges::any_of(result->notes, [](const std::string& note) {
    return note.find("% is passes farther than a pen and a half from their line") !=
           std::string::npos;
  }));
}

// A double edge, two and a half pens apart all along, is two lines; on them, not between. So is one
// whose second edge touches the first at its right end (there are 1.7 pens from middle to middle).
TEST(MergeStrokes, KeepsDoubleEdgesOfAPicture) {
  const auto result = consolidated({{40, 40}, {47.5, 47.5}, {90, 90}});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->strokes.size(), 3U);
  EXPECT_GT(result->explained, 0.99);
  const auto touching = consolidated({{40, 40}, {46.5, 45}, {90, 90}});
  ASSERT_TRUE(touching);
  EXPECT_EQ(touching->strokes.size(), 3U);
  EXPECT_GT(touching->explained, 0.99);
}

}  // namespace
}  // namespace keyline::sketch
