#include "keyline/sketch/turn_backs.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/polygon.h"
#include "keyline/sketch/trace.h"

namespace keyline::sketch {
namespace {

using core::Point2;

const PassModel kAnyHand{.width = 2};

/// Points along a polygon, even steps of a unit.
std::vector<Point2> along(const std::vector<Point2>& corners) {
  std::vector<Point2> points;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const double length = core::distance(corners[k], corners[k + 1]);
    const int steps = static_cast<int>(std::lround(length));
    for (int i = k == 0 ? 0 : 1; i <= steps; ++i)
      points.push_back(corners[k] + (1.0 * i / steps) * (corners[k + 1] - corners[k]));
  }
  return points;
}

/// An arc about the origin, drawn `passes` times there and back, 2 apart.
std::vector<Point2> scribble(int passes, double radius = 100) {
  std::vector<Point2> points;
  for (int k = 0; k < passes; ++k)
    for (int i = 0; i <= 120; ++i) {
      const double a = 0.01 * (k % 2 == 0 ? i : 120 - i);
      const double r = radius + 2.0 * k;
      points.push_back({r * std::cos(a), r * std::sin(a)});
    }
  return points;
}

TEST(TurnBacks, AreWhereTheLineIsDrawnAgain) {
  const auto backs = turn_backs(scribble(3), kAnyHand);
  ASSERT_EQ(backs.size(), 2U);
  EXPECT_NEAR(static_cast<double>(backs[0]), 120.5, 2);
  EXPECT_NEAR(static_cast<double>(backs[1]), 241.5, 2);
}

TEST(TurnBacks, AreNoCornersNorNarrowEnds) {
  EXPECT_TRUE(turn_backs(along({{0, 0}, {100, 0}, {0, 40}}), kAnyHand).empty());
  EXPECT_TRUE(turn_backs(along({{0, 0}, {100, 0}, {100, 4}, {0, 70}}), kAnyHand).empty());
  EXPECT_TRUE(turn_backs(along({{0, 0}, {100, 0}, {100, 30}, {0, 30}}), kAnyHand).empty());
  EXPECT_EQ(turn_backs(along({{0, 0}, {100, 0}, {100, 4}, {20, 4}}), kAnyHand).size(), 1U);
}

// Two thirds of the shorter way, here the second, have to run beside the other: of 100 steps behind
// the turn three quarters do, then three fifths. That the first is twice as long is no matter.
TEST(TurnBacks, RunBesideTheOtherWayForTwoThirds) {
  const auto back = [](double beside) {
    const double x = 200 - (beside - 12);  // 4 over to it, and 8 more until it is too far off
    return turn_backs(along({{0, 0}, {200, 0}, {200, 4}, {x, 4}, {x, 104 - beside + 8}}), kAnyHand);
  };
  ASSERT_EQ(back(75).size(), 1U);
  EXPECT_NEAR(static_cast<double>(back(75)[0]), 202, 6);
  EXPECT_TRUE(back(60).empty());
}

// The hand goes there and back without being lifted, and once more: one line of that length.
TEST(TurnBacks, DoNotDoubleTheLine) {
  std::vector<Point2> once = scribble(1);
  TraceOptions options;
  options.consolidate = true;
  const auto result = trace_strokes({{scribble(3)}, {once}, {{{200, 0}, {200, 80}}}}, 2, options);
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->strokes.size(), 2U);
  EXPECT_EQ(result->strokes[0].members, (std::vector<std::size_t>{0, 1}));
  EXPECT_NEAR(core::polygon_length(result->strokes[0].points), 1.2 * 102, 5);
  EXPECT_GT(result->explained, 0.98);
}

// The way back is as long beside the way there as it is away from it: they do not become one line,
// and what was drawn in one stroke stays one.
TEST(TurnBacks, WaysThatAreNotOneLineStayOneStroke) {
  const std::vector<Point2> stroke = along({{0, 0}, {100, 0}, {100, 6}, {40, 6}, {40, 46}});
  ASSERT_EQ(turn_backs(stroke, kAnyHand).size(), 1U);
  TraceOptions options;
  options.consolidate = true;
  const auto result = trace_strokes({{stroke}}, 2, options);
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->strokes.size(), 1U);
  EXPECT_NEAR(core::polygon_length(result->strokes[0].points), 206, 3);
}

// Kept strokes stay as they were drawn, those split are split as wholes.
TEST(TurnBacks, FollowWishes) {
  TraceOptions options;
  options.consolidate = true;
  options.wishes.keep = {0};
  const auto kept = trace_strokes({{scribble(3)}, {scribble(1)}}, 2, options);
  ASSERT_TRUE(kept) << kept.error().message;
  ASSERT_EQ(kept->strokes.size(), 2U);
  EXPECT_NEAR(core::polygon_length(kept->strokes[0].points), 3.6 * 102, 12);
  options.wishes = {};
  options.wishes.split = {{0, 1}};
  const auto split = trace_strokes({{scribble(3)}, {scribble(2, 101)}}, 2, options);
  ASSERT_TRUE(split) << split.error().message;
  ASSERT_EQ(split->strokes.size(), 2U);
  for (const Stroke& s : split->strokes) EXPECT_NEAR(core::polygon_length(s.points), 1.2 * 102, 5);
}

}  // namespace
}  // namespace keyline::sketch
