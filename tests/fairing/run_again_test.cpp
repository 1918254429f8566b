#include "keyline/fairing/run_again.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

namespace keyline::fairing::detail {
namespace {

/// A quarter of the unit circle from the origin, to the left: it ends in (1, 1).
RunResult quarter() {
  RunResult result;
  const double half = core::kPi / 2;
  result.fit.joints = {{{0, 0}, 0, 1}, {{1, 1}, half, 1}};
  result.fit.pieces = {{half, -1, PieceKind::arc}};
  result.chain = {{{0, 0}, 0}, {{-1, half, 1, 1}}, false};
  return result;
}

TEST(RunAgain, TellsByHowMuchABorderIsPassed) {
  const RunResult result = quarter();
  detail::Run run;
  EXPECT_TRUE(stays_inside(result, run));
  EXPECT_EQ(passed_most(result, run), 0);
  run.inside = {{{0, 1}, -0.1}};  // above y = -0.1
  EXPECT_TRUE(stays_inside(result, run));
  run.inside.push_back({{-1, 0}, -0.9});  // left of x = 0.9
  EXPECT_FALSE(stays_inside(result, run));
  EXPECT_NEAR(passed_most(result, run), 0.1, 1e-12);
  run.inside = {{{0, 1}, 0.25}};  // above y = 0.25, where it does not start
  EXPECT_FALSE(stays_inside(result, run));
  EXPECT_NEAR(passed_most(result, run), 0.25, 1e-12);
}

// Points at y = 0.2, a border at 0.1 and a margin of 0.05: the curve may lie 0.05 below them, in
// whatever unit it is solved.
TEST(RunAgain, MarginsAreInTheUnitOfThePoints) {
  for (const double scale : {1.0, 4.0}) {
    RunResult result;
    result.to_canonical.scale = scale;
    for (int i = 0; i < 9; ++i)
      result.points.push_back({.position = {scale * 0.05 * i, scale * 0.2}});
    detail::Run run;
    run.inside = {{{0, 1}, 0.1}};
    run.margin = {0.05};
    watch_borders(result, run, scale * 0.01);
    for (const FitPoint& p : result.points) {
      EXPECT_NEAR(p.highest, p.share * scale * 0.05, 1e-12) << scale;
      EXPECT_EQ(p.lowest, -HUGE_VAL);
    }
  }
}

/// The parabola y = x^2 from (0, 0) to (1, 1).
curve::BSpline2 parabola() {
  curve::BSpline2 spline;
  spline.knots = {0, 0, 0, 0, 1, 1, 1, 1};
  spline.control = {{0, 0}, {1 / 3.0, 0}, {2 / 3.0, 1 / 3.0}, {1, 1}};
  return spline;
}

// Clamps hold what the spline has at that end, in the run's own frame: half as large, a quarter
// turned, and moved.
TEST(HeldEnd, OfAClampIsWhatTheSplineHas) {
  detail::Run run;
  RunFrame frame;
  frame.to_canonical = {0.5, core::kPi / 2, {3, 4}};
  const double bend = 2 / std::pow(5, 1.5);
  EXPECT_EQ(held_end(run, frame, parabola(), true).hold, Hold::free);
  run.clamp_start = Clamp::g0;
  run.clamp_end = Clamp::g2;
  const HeldEnd start = held_end(run, frame, parabola(), true);
  EXPECT_EQ(start.hold, Hold::position);
  EXPECT_NEAR(core::distance(start.joint.position, {3, 4}), 0, 1e-14);
  EXPECT_NEAR(start.joint.direction, core::kPi / 2, 1e-14);
  EXPECT_NEAR(start.joint.curvature, 4, 1e-12);
  EXPECT_FALSE(start.slides);
  const HeldEnd end = held_end(run, frame, parabola(), false);
  EXPECT_EQ(end.hold, Hold::curvature);
  EXPECT_NEAR(core::distance(end.joint.position, {2.5, 4.5}), 0, 1e-14);
  EXPECT_NEAR(end.joint.direction, std::atan(2) + core::kPi / 2, 1e-14);
  EXPECT_NEAR(end.joint.curvature, bend / 0.5, 1e-12);
  // Taken from its end the curve runs the other way and bends to the other side.
  frame.reversed = true;
  const HeldEnd first = held_end(run, frame, parabola(), true);
  EXPECT_EQ(first.hold, Hold::curvature);
  EXPECT_NEAR(core::distance(first.joint.position, {2.5, 4.5}), 0, 1e-14);
  EXPECT_NEAR(std::remainder(first.joint.direction - std::atan(2) + core::kPi / 2, 2 * core::kPi),
              0, 1e-14);
  EXPECT_NEAR(first.joint.curvature, -bend / 0.5, 1e-12);
  EXPECT_EQ(held_end(run, frame, parabola(), false).hold, Hold::position);
  run.clamp_end = Clamp::g1;
  EXPECT_EQ(held_end(run, frame, parabola(), true).hold, Hold::direction);
  run.closed = true;
  EXPECT_EQ(held_end(run, frame, parabola(), true).hold, Hold::free);
}

TEST(HeldEnd, TiesHoldAPlace) {
  detail::Run run;
  run.tie_end = core::Point2{1, 2};
  RunFrame frame;
  frame.to_canonical = {2, 0, {0, 1}};
  EXPECT_EQ(held_end(run, frame, {}, true).hold, Hold::free);
  const HeldEnd end = held_end(run, frame, {}, false);
  EXPECT_EQ(end.hold, Hold::position);
  EXPECT_NEAR(core::distance(end.joint.position, {2, 5}), 0, 1e-15);
  frame.reversed = true;
  EXPECT_EQ(held_end(run, frame, {}, true).hold, Hold::position);
  EXPECT_EQ(held_end(run, frame, {}, false).hold, Hold::free);
}

// An end on the line of symmetry, which lies along x at 0.5, slides along it; crossing it smoothly
// it stands square: upwards where the curve leaves upwards or comes from below.
TEST(HeldEnd, OnAnAxisSlideAlongIt) {
  detail::Run run;
  run.axis = core::Pose2{{7, 0.5}, 0};
  run.start_on_axis = HalfEnd::square;
  run.end_on_axis = HalfEnd::corner;
  RunFrame frame;
  frame.points = {{0.1, 0.6}, {0.5, 1}, {0.9, 0.4}};
  const HeldEnd start = held_end(run, frame, {}, true);
  EXPECT_EQ(start.hold, Hold::direction);
  EXPECT_TRUE(start.slides);
  EXPECT_EQ(start.joint.position, (core::Point2{0.1, 0.5}));
  EXPECT_NEAR(start.joint.direction, core::kPi / 2, 1e-15);
  const HeldEnd end = held_end(run, frame, {}, false);
  EXPECT_EQ(end.hold, Hold::position);
  EXPECT_TRUE(end.slides);
  EXPECT_EQ(end.joint.position, (core::Point2{0.9, 0.5}));
  run.end_on_axis = HalfEnd::square;
  EXPECT_NEAR(held_end(run, frame, {}, false).joint.direction, -core::kPi / 2, 1e-15);
  frame.points[1].y = 0;  // below
  EXPECT_NEAR(held_end(run, frame, {}, true).joint.direction, -core::kPi / 2, 1e-15);
  EXPECT_NEAR(held_end(run, frame, {}, false).joint.direction, core::kPi / 2, 1e-15);
}

// A fifth more than the border is passed by, beside what there was.
TEST(RunAgain, MarginsGrowByWhatIsPassed) {
  const RunResult result = quarter();
  detail::Run run;
  run.inside = {{{-1, 0}, -0.9}, {{0, 1}, -0.1}};
  add_margin(run, result);
  ASSERT_EQ(run.margin.size(), 2U);
  EXPECT_NEAR(run.margin[0], 0.12, 1e-12);
  EXPECT_EQ(run.margin[1], 0);
  add_margin(run, result);
  EXPECT_NEAR(run.margin[0], 0.24, 1e-12);
}

TEST(RunAgain, OffsetsAreOfTheChainAsLaidOut) {
  RunResult result = quarter();
  detail::Run run;
  EXPECT_EQ(largest_offset(RunResult{}, run), HUGE_VAL);
  run.points = {{std::sin(0.4), 1.01 - std::cos(0.4)},
                {0.98 * std::sin(1.1), 1 - 0.98 * std::cos(1.1)}};
  result.fit.feet = {{0, 0.2}, {0, 0.7}};
  result.point_of = {0, 1};
  EXPECT_NEAR(largest_offset(result, run), 0.02, 1e-12);
}

}  // namespace
}  // namespace keyline::fairing::detail
