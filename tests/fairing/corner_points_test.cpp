#include "keyline/fairing/corner_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/core/polygon.h"
#include "keyline/fairing/fair.h"
#include "keyline/fairing/runs.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

core::Point2 on_circle(core::Point2 centre, double radius, double degrees) {
  return {centre.x + radius * std::cos(degrees * kDegree),
          centre.y + radius * std::sin(degrees * kDegree)};
}

// Circles of radius 5 about (-3, 0) and (3, 0) meet in (0, 4), at angles of 53.13 and 126.87
// degrees. Up to there the first, by steps of 2 degrees, from there on the second: the last point
// before the corner is 3.13 degrees away from it, the next one 0.87.
constexpr double kMeet = 53.13010235415598;
acquire::KeyLine two_arcs(double before, double after) {
  acquire::KeyLine line;
  for (int i = 20; i >= 0; --i)
    line.points.push_back(on_circle({-3, 0}, 5, kMeet - before - 2 * i));
  line.corners = {line.points.size() - 1};
  for (int i = after > 0 ? 0 : 1; i <= 20; ++i)
    line.points.push_back(on_circle({3, 0}, 5, 180 - kMeet + after + 2 * i));
  line.length = 10 * 41 * kDegree;
  return line;
}

std::vector<Run> met(const acquire::KeyLine& line, const FairOptions& options = {}) {
  std::vector<Run> runs = runs_of(line, options);
  meet_between_points(runs, 0.01, false);
  return runs;
}

TEST(CornerPoints, AreLeftToTheSideWhoseCurveTheyLieOn) {
  const acquire::KeyLine line = two_arcs(1.13, 0.87);
  const auto runs = met(line);
  ASSERT_EQ(runs.size(), 2U);
  ASSERT_EQ(runs[0].points.size(), 22U);
  ASSERT_EQ(runs[1].points.size(), 22U);
  EXPECT_EQ(runs[0].points[20], line.points[20]);
  EXPECT_EQ(runs[0].index[21], Run::none);
  EXPECT_EQ(runs[1].index[0], Run::none);
  EXPECT_EQ(runs[1].index[1], 21U);
  EXPECT_NEAR(runs[0].points[21].x, 0, 1e-3);
  EXPECT_NEAR(runs[0].points[21].y, 4, 1e-3);
  EXPECT_EQ(runs[0].points[21], runs[1].points[0]);
  // Backwards the corner's point is the second run's.
  acquire::KeyLine back = line;
  std::ranges::reverse(back.points);
  back.corners = {21};
  const auto other = met(back);
  ASSERT_EQ(other[1].points.size(), 22U);
  EXPECT_EQ(other[1].points[1], back.points[21]);
  EXPECT_EQ(other[1].index[0], Run::none);
  EXPECT_NEAR(other[0].points.back().y, 4, 1e-3);
}

// What a run holds beside its points goes along: the place that lies beyond an end has that end's
// weight, points to be passed keep their places, and the length grows as the polygon does.
TEST(CornerPoints, TakeAlongWhatTheRunHolds) {
  acquire::KeyLine back = two_arcs(1.13, 0.87);
  std::ranges::reverse(back.points);
  back.corners = {21};
  for (const bool start : {false, true}) {
    auto runs = runs_of(start ? back : two_arcs(1.13, 0.87), {});
    auto& run = runs[start ? 1 : 0];
    run.weights.assign(run.points.size(), 1);
    run.weights.front() = 2;
    run.weights.back() = 3;
    run.must_pass = {5};
    const core::Point2 fifth = run.points[5];
    const double share = run.length / core::polygon_length(run.points, false);
    meet_between_points(runs, 0.01, false);
    ASSERT_EQ(run.points.size(), 22U);
    ASSERT_EQ(run.weights.size(), 22U);
    EXPECT_EQ(start ? run.weights[0] : run.weights[21], start ? 2 : 3);
    EXPECT_EQ(start ? run.weights[1] : run.weights[20], start ? 2 : 3);
    ASSERT_EQ(run.must_pass.size(), 1U);
    EXPECT_EQ(run.points[run.must_pass[0]], fifth);
    EXPECT_NEAR(run.length / core::polygon_length(run.points, false), share, 1e-12 * share);
  }
}

TEST(CornerPoints, StayWithBothWhereTheyAreTheCorner) {
  const auto runs = met(two_arcs(0, 0));
  EXPECT_EQ(runs[0].points.size() + runs[1].points.size(), 42U);
  EXPECT_EQ(std::ranges::count(runs[0].index, Run::none), 0);
  // Nor is a point given to one side that has to be passed.
  FairOptions passing;
  passing.must_pass = {20};
  const auto held = met(two_arcs(1.13, 0.87), passing);
  EXPECT_EQ(held[0].points.size() + held[1].points.size(), 43U);
}

// One of two runs holds the point they share: it has to be passed there.
TEST(CornerPoints, StayWhereEitherRunHasToPassThem) {
  for (const std::size_t holder : {0U, 1U}) {
    auto runs = runs_of(two_arcs(1.13, 0.87), {});
    runs[holder].must_pass = {holder == 0 ? runs[0].points.size() - 1 : 0};
    meet_between_points(runs, 0.01, false);
    EXPECT_EQ(runs[0].points.size() + runs[1].points.size(), 43U) << holder;
    EXPECT_EQ(std::ranges::count(runs[0].index, Run::none), 0) << holder;
  }
}

// The corner's point lies 0.02 within the first circle and some 0.09 beside the second: it is the
// first run's where that much is allowed.
TEST(CornerPoints, AreOfASideThatPassesThemWithinTheTolerance) {
  acquire::KeyLine line = two_arcs(1.13, 0.87);
  line.points[20] = on_circle({-3, 0}, 4.98, kMeet - 1.13);
  for (const double tolerance : {0.0195, 0.0205}) {
    auto runs = runs_of(line, {});
    meet_between_points(runs, tolerance, false);
    EXPECT_EQ(std::ranges::count(runs[0].index, Run::none), tolerance > 0.02 ? 1 : 0) << tolerance;
  }
}

// A drop: two arcs of 5 about (-3, 0) and (3, 0) from (0, 4) to (0, -4) whose points leave out the
// tip at the top and take the one below.
TEST(CornerPoints, OneCornerOfAClosedOutlineIsWhereBothItsEndsGoOnTo) {
  acquire::KeyLine line;
  line.closed = true;
  const auto arc = [&](double from, double to, core::Point2 centre) {
    for (int i = 0; i <= 40; ++i)
      line.points.push_back(on_circle(centre, 5, from + (to - from) * i / 40));
  };
  arc(kMeet - 1.13, -kMeet, {-3, 0});
  line.points.pop_back();
  arc(180 + kMeet, 180 - kMeet + 0.87, {3, 0});
  line.corners = {0};
  line.length = core::polygon_length(line.points, true);
  auto runs = runs_of(line, {});
  ASSERT_EQ(runs.size(), 1U);
  meet_between_points(runs, 0.01, true);
  EXPECT_EQ(runs[0].points.size(),
            line.points.size() + 2);  // the tip at both ends for point 0 at one
  EXPECT_EQ(runs[0].points.front(), runs[0].points.back());
  EXPECT_EQ(runs[0].index.front(), Run::none);
  EXPECT_EQ(runs[0].index[1], 0U);
  EXPECT_EQ(runs[0].index.back(), Run::none);
  EXPECT_NEAR(runs[0].points.front().x, 0, 1e-3);
  EXPECT_NEAR(runs[0].points.front().y, 4, 1e-3);
  auto smooth = runs_of(line, {});
  smooth[0].closed = true;  // it has no ends that could meet
  meet_between_points(smooth, 0.01, true);
  EXPECT_EQ(smooth[0].points, runs_of(line, {})[0].points);
}

// Asked to come to the first side's last point as well, the second arc would begin with a hook.
TEST(CornerPoints, ArcsThatMeetBetweenPointsComeOutAsArcs) {
  FairOptions options;
  options.tolerance = 0.01;
  const auto found = fair(two_arcs(1.13, 0.87), options);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->curves.size(), 2U);
  EXPECT_TRUE(found->within_tolerance);
  EXPECT_EQ(found->fairness.answer.waves, 0);
  EXPECT_EQ(found->pieces.size(), 2U);
  const auto& second = std::get<lac::Chain>(found->curves[1]);
  EXPECT_NEAR(second.start.position.x, 0, 1e-3);
  EXPECT_NEAR(second.start.position.y, 4, 1e-3);
  EXPECT_NEAR(second.pieces.front().curvature_start, 0.2, 1e-3);
}

}  // namespace
}  // namespace keyline::fairing::detail
