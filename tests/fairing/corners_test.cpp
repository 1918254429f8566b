#include "keyline/fairing/corners.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/fairing/fair.h"

#include "truth.h"

/// Chains brought together at corners: where they meet, and where they stay.
namespace keyline::fairing::detail {
namespace {

using core::Point2;

/// A run of points along a line, and a straight chain that lies beside it by `off` to the left.
struct Side {
  Run run;
  RunResult result;
  Side(Point2 from, Point2 to, double off) {
    const core::Vector2 way = to - from;
    const double length = core::norm(way), direction = core::direction_of(way);
    const core::Vector2 aside = (off / length) * core::perpendicular_left(way);
    for (int i = 0; i <= 20; ++i) {
      run.points.push_back(core::mix(from, to, i / 20.0));
      result.points.push_back({.position = run.points.back()});
      result.fit.feet.push_back({0, i / 20.0});
      result.point_of.push_back(static_cast<std::size_t>(i));
    }
    run.length = length;
    result.fit.joints = {{from + aside, direction, 0}, {to + aside, direction, 0}};
    result.fit.pieces = {{.length = length}};
    result.fit.first_at_start = result.fit.last_at_end = true;
    result.chain = {{from + aside, direction}, {{-1, length, 0, 0}}, false};
    result.accept = {.tolerance = 0.1, .noise = 0};
    result.within_tolerance = true;
  }
};

struct Given {
  std::vector<Run> runs;
  std::vector<RunResult> solved;
  void add(const Side& side) {
    runs.push_back(side.run);
    solved.push_back(side.result);
  }
  void tie(bool round, double tolerance = 0.1) {
    tie_corners(
        runs, solved, {},
        [=](std::size_t) {
          RunOptions options;
          options.tolerance = tolerance;
          options.threads = 1;
          return options;
        },
        round);
  }
  Point2 end(std::size_t k) const { return lac::end_pose(solved[k].chain).position; }
  Point2 start(std::size_t k) const { return solved[k].chain.start.position; }
};

void expect_at(Point2 found, Point2 meant) {
  EXPECT_NEAR(found.x, meant.x, 1e-9);
  EXPECT_NEAR(found.y, meant.y, 1e-9);
}

// Chains that end at (1, 0.02) and (1.02, 0): they meet half way between.
TEST(TieCorners, ChainsMeetHalfWay) {
  Given g;
  g.add(Side({0, 0}, {1, 0}, 0.02));
  g.add(Side({1, 0}, {1, 1}, -0.02));
  g.tie(false);
  expect_at(g.end(0), {1.01, 0.01});
  expect_at(g.start(1), {1.01, 0.01});
  EXPECT_EQ(g.runs[0].tie_end, g.runs[1].tie_start);
  EXPECT_FALSE(g.runs[0].tie_start);
  EXPECT_FALSE(g.runs[1].tie_end);
}

// No farther from the corner's own point than 0.9 of the tolerance.
TEST(TieCorners, WithinTheToleranceOfTheCorner) {
  Given g;
  g.add(Side({0, 0}, {1, 0}, 0.02));
  g.add(Side({1, 0}, {1, 1}, -0.02));
  g.tie(false, 0.01);
  const double off = 0.9 * 0.01 / std::sqrt(2.0);
  ASSERT_TRUE(g.runs[0].tie_end);
  expect_at(*g.runs[0].tie_end, {1 + off, off});
}

TEST(TieCorners, InsideWhatBoundsThem) {
  Given g;
  g.add(Side({0, 0}, {1, 0}, 0.02));
  g.add(Side({1, 0}, {1, 1}, -0.02));
  for (detail::Run& run : g.runs) run.inside = {{{-1, 0}, -1.004}, {{0, 1}, -5}};  // x <= 1.004
  g.tie(false);
  ASSERT_TRUE(g.runs[0].tie_end);
  expect_at(*g.runs[0].tie_end, {1.004, 0.01});
}

// Round: the last one meets the first.
TEST(TieCorners, OfAClosedLineTheLastMeetsTheFirst) {
  for (const bool round : {false, true}) {
    Given g;
    g.add(Side({0, 0}, {1, 0}, -0.02));
    g.add(Side({1, 0}, {0.5, 0.8}, -0.02));
    g.add(Side({0.5, 0.8}, {0, 0}, -0.02));
    const Point2 was = core::mix(g.end(2), g.start(0), 0.5);
    g.tie(round);
    for (const std::size_t k : {0U, 1U}) expect_at(g.end(k), g.start(k + 1));
    if (round) expect_at(g.start(0), was);
    EXPECT_EQ(g.runs[0].tie_start.has_value(), round);
    EXPECT_EQ(core::distance(g.end(2), g.start(0)) < 1e-9, round);
  }
}

// A clamped end stays where it is clamped, so that nothing is tied there.
TEST(TieCorners, ClampedEndsStay) {
  for (const bool end : {true, false}) {
    Given g;
    g.add(Side({0, 0}, {1, 0}, 0.02));
    g.add(Side({1, 0}, {1, 1}, -0.02));
    (end ? g.runs[0].clamp_end : g.runs[1].clamp_start) = Clamp::g0;
    g.tie(false);
    EXPECT_FALSE(g.runs[0].tie_end);
    EXPECT_FALSE(g.runs[1].tie_start);
    expect_at(g.end(0), {1, 0.02});
    expect_at(g.start(1), {1.02, 0});
  }
}

TEST(TieCorners, AClosedRunHasNone) {
  Given g;
  g.add(Side({0, 0}, {1, 0}, 0.02));
  g.runs[0].closed = true;
  g.tie(true);
  EXPECT_FALSE(g.runs[0].tie_end);
  expect_at(g.end(0), {1, 0.02});
}

// Aerofoils of NACA's family of four digits with a blunt tail 0.0008 high that one point closes:
// pieces chosen for ends that stop short of it had to turn into it within the last of them.
TEST(TieCorners, PiecesThatStrainToATipGiveWayToOthers) {
  for (const double thickness : {0.1, 0.12}) {
    SCOPED_TRACE(thickness);
    std::vector<Point2> outline{{1, 0}};
    for (int i = -39; i <= 39; ++i) {
      const double x = (1 + std::cos(core::kPi * (40 - std::abs(i)) / 40)) / 2;
      const double half =
          5 * thickness *
              (0.2969 * std::sqrt(x) + x * (-0.126 + x * (-0.3516 + x * (0.2843 - 0.1036 * x)))) +
          4e-4 * x;
      outline.push_back(
          {1e-6 * std::round(1e6 * x), 1e-6 * std::round(i < 0 ? 1e6 * half : -1e6 * half)});
    }
    outline.push_back({1, 0});
    FairOptions options;
    options.tolerance = 1e-4;
    const FairResult result = fair(testing::line_through(outline), options).value();
    EXPECT_TRUE(result.within_tolerance);
    EXPECT_TRUE(result.fairness.fair);
    // Of what the smoothest spline as near has, which need not close at the tail.
    EXPECT_LT(result.fairness.answer.energy, 0.6 * result.fairness.smoothing_spline->energy);
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
