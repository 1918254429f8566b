#include "keyline/sketch/two_lines.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/sketch/consolidate.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using Places = std::vector<std::size_t>;

constexpr double kPen = 4;

DrawnStroke drawn(const std::function<Point2(double)>& curve, double from, double to) {
  DrawnStroke stroke;
  for (int i = 0; i <= 200; ++i) stroke.points.push_back(curve(from + (to - from) * i / 200));
  return stroke;
}

/// 600 long, at these heights, along each other.
std::vector<DrawnStroke> passes(const std::vector<double>& heights) {
  std::vector<DrawnStroke> strokes;
  for (const double y : heights)
    strokes.push_back(drawn([y](double x) { return Point2{x, y + 2 * std::sin(x / 40)}; }, 0, 600));
  return strokes;
}

/// With passes of a line far off, which show how the hand errs.
std::vector<DrawnStroke> with_others(std::vector<DrawnStroke> strokes) {
  for (DrawnStroke& s : passes({1000, 1002, 1003, 1005, 1007, 1008, 1010}))
    strokes.push_back(std::move(s));
  return strokes;
}

/// What of the strokes is two lines, as one group beside others.
std::vector<TwoLines> told(const std::vector<DrawnStroke>& strokes, double pen = kPen) {
  std::vector<SampledStroke> sampled;
  for (const DrawnStroke& s : with_others(strokes))
    sampled.push_back(sample_stroke(s.points, s.closed, pen));
  Places all(strokes.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Places others(sampled.size() - all.size());
  std::iota(others.begin(), others.end(), all.size());
  std::vector<TwoLines> found = two_lines(sampled, {all, others}, {.width = pen});
  for (TwoLines& lines : found) {
    std::ranges::sort(lines.one);
    std::ranges::sort(lines.other);
  }
  return found;
}

// A cup's side and its bottom, each drawn three times, go on in each other; an outline of single
// strokes, each a little over the last one's end, is one line.
TEST(TwoLines, TellsLinesThatTheHandWasLiftedBetween) {
  const auto part = [](double from, double to, double offset) {
    return drawn([offset](double x) { return Point2{x, offset + 100 * std::cos(x / 200)}; }, from,
                 to);
  };
  const std::vector<DrawnStroke> lifted = {part(0, 300, 0),   part(4, 304, 2),
                                           part(-3, 290, -2), part(298, 600, 1),
                                           part(305, 590, 3), part(301, 598, -1)};
  const auto found = told(lifted);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].one, (Places{0, 1, 2}));
  EXPECT_EQ(found[0].other, (Places{3, 4, 5}));
  std::vector<DrawnStroke> crossed = lifted;
  crossed.push_back(part(200, 420, 1));
  EXPECT_TRUE(told(crossed).empty());
  std::vector<DrawnStroke> in_turn;
  for (int k = 0; k < 8; ++k) in_turn.push_back(part(80 * k, 80 * k + 100, k % 3));
  EXPECT_TRUE(told(in_turn).empty());
  // two stretches of strokes that overlap by more than a third; none is drawn whole by one stroke
  std::vector<DrawnStroke> overlapping;
  for (const double begin : {0.0, 270.0})
    for (int k = 0; k < 4; ++k)
      overlapping.push_back(part(begin + 60 * k, begin + 60 * k + 100, k % 3));
  EXPECT_TRUE(told(overlapping).empty());
}

// A construction line through a car's sill: it runs along it for a third of its way.
TEST(TwoLines, TellsALineThatLeavesOthersGently) {
  std::vector<DrawnStroke> strokes = passes({0, 3, -3, 1});
  strokes.push_back(drawn([](double x) { return Point2{x, 0.1 * (x - 300)}; }, -20, 620));
  const auto found = told(strokes);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].one, (Places{0, 1, 2, 3}));
  EXPECT_EQ(found[0].other, Places{4});
  strokes = with_others(strokes);
  const auto lines = consolidate(strokes, {.width = kPen, .measured = true});
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].members, (Places{0, 1, 2, 3}));
  const auto joined =
      consolidate(strokes, {.width = kPen, .measured = true, .wishes = {{}, {{0, 4}}, {}}});
  ASSERT_EQ(joined.size(), 2U);
  EXPECT_EQ(joined[0].members.size(), 5U);
}

// A teapot's base lies on its belly along half of its way and leaves it on both sides.
TEST(TwoLines, TellsALineThatLiesOnAnotherForHalfOfItsWay) {
  std::vector<DrawnStroke> strokes = passes({0, 0.5, -0.5, 1});
  for (const double offset : {-0.5, 0.5})
    strokes.push_back(drawn(
        [offset](double x) {
          const double beyond = std::max(0.0, std::abs(x - 300) - 150);
          return Point2{x, offset + 2 * std::sin(x / 40) + 0.12 * beyond};
        },
        0, 600));
  const auto found = told(strokes);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].one, (Places{0, 1, 2, 3}));
  EXPECT_EQ(found[0].other, (Places{4, 5}));
}

TEST(TwoLines, LeavesAnEvenSpreadAndTellsOneWithAGap) {
  std::vector<double> heights = {0, 8, 16, 24, 32, 40, 48, 56};
  EXPECT_TRUE(told(passes(heights)).empty());
  for (std::size_t i = 4; i < 8; ++i) heights[i] += 30;
  const auto found = told(passes(heights));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].one, (Places{0, 1, 2, 3}));
  EXPECT_EQ(found[0].other, (Places{4, 5, 6, 7}));
}

TEST(TwoLines, LeavesWhatHasNoRoomBetween) {
  const std::vector<DrawnStroke> strokes = passes({0, 1, 2, 7, 8, 9});
  EXPECT_TRUE(told(strokes).empty());
  EXPECT_EQ(told(strokes, 2).size(), 1U);
}

// The upper half of a flat ring and its lower one face each other; a pass goes all around.
TEST(TwoLines, TakesOppositeSidesOfARingForOneLine) {
  const auto ring = [](double offset) {
    return [offset](double t) {
      return Point2{(150 + offset) * std::cos(t), (25 + offset) * std::sin(t)};
    };
  };
  const double round = 2 * std::numbers::pi;
  for (const bool turned : {false, true}) {
    std::vector<DrawnStroke> strokes = {drawn(ring(0), 0, round)};
    for (const double offset : {-2.0, 1.0, 2.0}) {
      strokes.push_back(drawn(ring(offset), 0.2, 2.9));
      strokes.push_back(drawn(ring(-offset), 3.3, 6));
      if (turned) std::ranges::reverse(strokes.back().points);
    }
    EXPECT_TRUE(told(strokes).empty());
  }
}

}  // namespace
}  // namespace keyline::sketch
