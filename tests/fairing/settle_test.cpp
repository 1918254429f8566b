#include "keyline/fairing/settle.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

/// From an accepted chain to the one given out.
namespace keyline::fairing::detail {
namespace {

constexpr double kPi = std::numbers::pi;

FitChain from(const lac::Chain& chain, int per_piece, std::vector<FitPoint>& points) {
  FitChain out;
  const auto segments = lac::segments(chain);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const lac::Segment& s = segments[i];
    out.joints.push_back({s.start.position, s.start.direction, s.curvature_start});
    out.pieces.push_back({.length = s.length, .alpha = s.alpha});
    for (int k = i == 0 ? 0 : 1; k <= per_piece; ++k) {
      const double t = double(k) / per_piece;
      points.push_back({.position = lac::evaluate(s, t)});
      out.feet.push_back({static_cast<int>(i), t});
    }
  }
  const core::Pose2 end = lac::end_pose(chain);
  out.joints.push_back({end.position, end.direction, segments.back().curvature_end});
  return out;
}

TEST(Settle, TurnsToEitherSideAddUp) {
  std::vector<FitPoint> points;
  FitChain chain = from({{{0, 0}, 0}, {{-1, 0.5, 1, 3}, {-1, 0.5, 3, -3}}, false}, 2, points);
  // Half of 1 and 3 in the mean; an S through nothing, whose turns cancel, counts for none.
  EXPECT_NEAR(turned(chain), 1.0, 1e-12);
  chain.joints[2].curvature = -5;
  EXPECT_NEAR(turned(chain), 1.0 + 0.5, 1e-12);
}

TEST(Flatten, GivesLinesAndArcsOneCurvature) {
  FitChain chain;
  chain.joints = {{{}, 0, 0.3}, {{}, 0, 1}, {{}, 0, 2}, {{}, 0, 4}};
  chain.pieces.assign(3, {.length = 1, .alpha = 0.5});
  chain.pieces[1].kind = PieceKind::arc;
  flatten(chain);
  EXPECT_EQ(chain.joints[0].curvature, 0.3);
  EXPECT_EQ(chain.joints[1].curvature, 1.5);
  EXPECT_EQ(chain.joints[2].curvature, 1.5);
  EXPECT_EQ(chain.joints[3].curvature, 4);
  EXPECT_EQ(chain.pieces[0].alpha, 0.5);
  EXPECT_EQ(chain.pieces[1].alpha, -1);
  chain.pieces[1].kind = PieceKind::line;
  flatten(chain);
  EXPECT_EQ(chain.joints[1].curvature, 0);
  EXPECT_EQ(chain.joints[2].curvature, 0);
}

// A closed chain's last joint is its first.
TEST(Flatten, GoesRoundTheSeam) {
  FitChain chain;
  chain.closed = true;
  chain.joints = {{{}, 0, 2}, {{}, 0, 3}, {{}, 0, 5}, {{}, 0, 2}};
  chain.pieces.assign(3, {.length = 1, .alpha = 0.5});
  chain.pieces[0].kind = PieceKind::arc;
  flatten(chain);
  EXPECT_EQ(chain.joints[3].curvature, 2.5);
  chain.pieces[0].kind = PieceKind::curve;
  chain.pieces[2].kind = PieceKind::line;
  flatten(chain);
  EXPECT_EQ(chain.joints[0].curvature, 0);
  EXPECT_EQ(chain.joints[2].curvature, 0);
}

// What is straight, round or bent in the truth comes out as that.
TEST(Straighten, FindsLinesAndArcs) {
  const lac::Chain truth{
      {{0, 0}, 0}, {{-1, 0.3, 1e-5, 0}, {-1, 0.3, 0, 3}, {-1, 0.4, 3, 3.0001}}, false};
  std::vector<FitPoint> points;
  FitChain chain = from(truth, 20, points);
  const int changed = straighten(chain, points, {.tolerance = 1e-3, .noise = 1e-4});
  EXPECT_EQ(changed, 2);
  EXPECT_EQ(chain.pieces[0].kind, PieceKind::line);
  EXPECT_EQ(chain.pieces[1].kind, PieceKind::curve);
  EXPECT_EQ(chain.pieces[2].kind, PieceKind::arc);
  EXPECT_EQ(chain.joints[1].curvature, 0);
  EXPECT_NEAR(chain.joints[2].curvature, chain.joints[3].curvature, 1e-12);
}

// What bends out of a line starts at curvature 0, where its variation is finite for slopes below 0
// alone: one that was above is made to.
TEST(Straighten, NeighboursOfALineReachIt) {
  std::vector<FitPoint> points;
  FitChain chain = from({{{0, 0}, 0}, {{-1, 0.5, 0, 0}, {-1, 0.5, 0, 2}}, false}, 20, points);
  chain.joints[0].curvature = chain.joints[1].curvature = 1e-3;
  chain.pieces[1].alpha = 0.5;
  EXPECT_EQ(straighten(chain, points, {.tolerance = 1e-3, .noise = 1e-4}), 1);
  EXPECT_EQ(chain.pieces[0].kind, PieceKind::line);
  EXPECT_LT(chain.pieces[1].alpha, 0);
  for (const double offset : offsets(chain, points)) EXPECT_LT(std::abs(offset), 1e-4);
}

// Neither a bend that is plain to see nor one that departs by a few tolerances becomes a line.
TEST(Straighten, LeavesWhatPlainlyBends) {
  const lac::Chain truth{{{0, 0}, 0}, {{-1, 0.5, 0.5, 2}, {-1, 0.5, 2, 6}}, false};
  std::vector<FitPoint> points;
  FitChain chain = from(truth, 20, points);
  EXPECT_EQ(straighten(chain, points, {.tolerance = 1e-3, .noise = 1e-5}), 0);
}

// An S between equal turns has a chord that its ends alone do not tell: it is no line either.
TEST(Straighten, AnSIsNoLine) {
  const lac::Chain truth{{{0, 0}, 0.5}, {{-1, 1, -6, 6}}, false};
  std::vector<FitPoint> points;
  FitChain chain = from(truth, 40, points);
  EXPECT_EQ(straighten(chain, points, {.tolerance = 2e-2, .noise = 1e-5}), 0);
}

// One closed piece has no neighbour to bend instead: it stays, though it is a circle.
TEST(Straighten, OnePieceThatIsClosedStays) {
  std::vector<FitPoint> points;
  FitChain chain =
      from({{{1 / (2 * kPi), 0}, kPi / 2}, {{-1, 1, 2 * kPi, 2 * kPi}}, true}, 40, points);
  points.pop_back();
  chain.feet.pop_back();
  chain.closed = true;
  chain.turning = 2 * kPi;
  EXPECT_EQ(straighten(chain, points, {.tolerance = 1e-3, .noise = 1e-4}), 0);
  EXPECT_EQ(chain.pieces[0].kind, PieceKind::curve);
  // An open one of the same points becomes the arc that it is.
  chain.closed = false;
  EXPECT_EQ(straighten(chain, points, {.tolerance = 1e-3, .noise = 1e-4}), 1);
  EXPECT_EQ(chain.pieces[0].kind, PieceKind::arc);
}

// Gaps close, and the points are met better than before.
TEST(Polish, ClosesGapsAndKeepsTheTolerance) {
  const lac::Chain truth{{{0, 0}, 0.1}, {{-0.7, 0.5, 0.5, 2}, {0.8, 0.5, 2, 4}}, false};
  std::vector<FitPoint> points;
  FitChain chain = from(truth, 20, points);
  chain.joints[1].position.y += 2e-4;
  chain.joints[1].curvature *= 1.01;
  chain.first_at_start = chain.last_at_end = true;
  ASSERT_TRUE(polish(chain, points, {.tolerance = 1e-3, .noise = 0}, true));
  const ChainFitReport report = fit_chain(chain, points, {.iterations = 0, .fine = true});
  EXPECT_LT(report.max_gap, 1e-9);
  EXPECT_LT(report.max_offset, 1e-5);
}

TEST(Polish, SaysWherePointsDoNotPass) {
  const lac::Chain truth{{{0, 0}, 0.1}, {{-1, 1, 0.5, 2}}, false};
  std::vector<FitPoint> points;
  FitChain chain = from(truth, 20, points);
  points[10].position.y += 0.05;
  EXPECT_FALSE(polish(chain, points, {.tolerance = 1e-3, .noise = 0}, false));
}

TEST(LayOut, RunsBackInThePointsFrame) {
  FitChain chain;
  chain.joints = {{{0, 0}, 0, 1}, {{0, 0}, 0, 3}, {{0, 0}, 0, -1}};
  chain.pieces = {{.length = 0.5, .alpha = 0.5}, {.length = 0.5, .alpha = 0.5}};
  // The frame is half as large and a quarter turned.
  const core::Similarity2 frame{0.5, kPi / 2, {0.25, 0}};
  const lac::Chain forward = lay_out(chain, frame, false);
  ASSERT_EQ(forward.pieces.size(), 2U);
  EXPECT_NEAR(forward.pieces[0].length, 1, 1e-15);
  EXPECT_NEAR(forward.pieces[0].curvature_start, 0.5, 1e-15);
  EXPECT_NEAR(forward.pieces[1].curvature_end, -0.5, 1e-15);
  EXPECT_EQ(forward.pieces[0].alpha, 0.5);
  EXPECT_EQ(forward.pieces[1].alpha, -1);  // of a slope of 0 or more nothing passes zero
  const core::Point2 start = core::apply(frame, forward.start.position);
  EXPECT_NEAR(start.x, 0, 1e-15);
  EXPECT_NEAR(start.y, 0, 1e-15);
  EXPECT_NEAR(forward.start.direction, -kPi / 2, 1e-15);
  const lac::Chain back = lay_out(chain, frame, true);
  EXPECT_NEAR(back.pieces[0].curvature_start, 0.5, 1e-15);
  EXPECT_NEAR(core::distance(lac::end_pose(back).position, forward.start.position), 0, 1e-14);
}

TEST(LayOut, HeldEndsAreMet) {
  std::vector<FitPoint> points;
  FitChain chain = from({{{0, 0}, 0.1}, {{-1, 0.5, 0.5, 2}, {-1, 0.5, 2, 4}}, false}, 2, points);
  for (const Hold hold : {Hold::position, Hold::direction}) {
    chain.hold_end = hold;
    chain.hold_start = Hold::curvature;
    FitChain given = chain;
    given.joints.back().position.x += 1e-4;
    given.joints.back().direction -= 1e-4;
    const lac::Chain laid = lay_out(given, {}, false);
    const core::Pose2 end = lac::end_pose(laid);
    EXPECT_NEAR(core::distance(end.position, given.joints.back().position), 0, 1e-14);
    EXPECT_EQ(std::abs(end.direction - given.joints.back().direction) < 1e-14,
              hold == Hold::direction);
    EXPECT_EQ(laid.start.direction, 0.1);
    EXPECT_EQ(laid.pieces[0].curvature_start, 0.5);
    EXPECT_NE(laid.pieces[1].curvature_end, 4);
  }
}

// Beside a line no line: one of two straight pieces stays a curve.
TEST(Straighten, NothingStraightBesideALine) {
  std::vector<FitPoint> points;
  FitChain chain = from({{{0, 0}, 0.1}, {{-1, 0.5, 0, 0}, {-1, 0.5, 0, 0}}, false}, 20, points);
  chain.joints[1].curvature = 1e-5;
  EXPECT_EQ(straighten(chain, points, {.tolerance = 1e-3, .noise = 1e-4}), 1);
  EXPECT_EQ(chain.pieces[0].kind, PieceKind::line);
  EXPECT_EQ(chain.pieces[1].kind, PieceKind::curve);
}

// A circle in four pieces, a little off: laid out it comes back to its start, a turn on, with one
// curvature at the seam.
TEST(LayOut, ClosedChainsMeet) {
  FitChain chain;
  chain.closed = true;
  chain.turning = 2 * kPi;
  for (int i = 0; i <= 4; ++i) {
    const double t = kPi / 2 * i;
    chain.joints.push_back({{std::cos(t), std::sin(t)}, t + kPi / 2, 1 + 1e-3 * (i % 4)});
    if (i < 4) chain.pieces.push_back({.length = kPi / 2 * (1 + 1e-3 * i)});
  }
  chain.joints[4].curvature = 1.0004;
  const lac::Chain laid = lay_out(chain, {}, false);
  EXPECT_TRUE(laid.closed);
  const core::Pose2 end = lac::end_pose(laid);
  EXPECT_NEAR(core::distance(end.position, laid.start.position), 0, 1e-13);
  EXPECT_NEAR(end.direction - laid.start.direction, 2 * kPi, 1e-12);
  EXPECT_EQ(laid.pieces.back().curvature_end, laid.pieces.front().curvature_start);
}

// The start gives way where it is not held, the end where nothing but its place is.
TEST(LayOut, WhatIsNotHeldGivesWay) {
  std::vector<FitPoint> points;
  FitChain chain = from({{{0, 0}, 0.1}, {{-1, 0.5, 0.5, 2}, {-1, 0.5, 2, 4}}, false}, 2, points);
  chain.joints.back().position.x += 1e-4;
  chain.hold_end = Hold::curvature;
  for (const Hold start : {Hold::position, Hold::direction, Hold::curvature}) {
    chain.hold_start = start;
    const lac::Chain laid = lay_out(chain, {}, false);
    EXPECT_EQ(laid.start.direction == 0.1, start >= Hold::direction);
    EXPECT_EQ(laid.pieces[0].curvature_start == 0.5, start >= Hold::curvature);
    EXPECT_EQ(laid.pieces[1].curvature_end, 4);
    EXPECT_NEAR(core::distance(lac::end_pose(laid).position, chain.joints.back().position), 0,
                1e-13);
  }
  chain.hold_end = Hold::free;
  EXPECT_EQ(lay_out(chain, {}, false).pieces[1].length, 0.5);
}

}  // namespace
}  // namespace keyline::fairing::detail
