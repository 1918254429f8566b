#include "keyline/lac/chain/chain.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

/// A chain as one curve, by its pieces.
namespace keyline::lac {
namespace {

constexpr double kPi = std::numbers::pi;

Chain three() {
  return {{{1, 2}, 0.3}, {{-1, 1, 0.5, 1}, {0.5, 2, 1, 3}, {-2, 1, 3, -0.5}}, false};
}

TEST(Chain, LengthsAndTurnsAddUp) {
  const Chain c = three();
  EXPECT_EQ(arc_length(c), 4);
  double turned = 0;
  for (const Piece& p : c.pieces) turned += total_turning(p);
  EXPECT_NEAR(total_turning(c), turned, 1e-15);
  EXPECT_NEAR(end_pose(c).direction, 0.3 + turned, 1e-14);
}

// A joint belongs to the piece behind it, the end to the last.
TEST(Chain, LocatesBySharesOfTheLength) {
  const Chain c = three();
  const auto at = [&](double t) { return locate(c, t); };
  EXPECT_EQ(at(0).piece, 0U);
  EXPECT_EQ(at(0.125).piece, 0U);
  EXPECT_EQ(at(0.125).t, 0.5);
  EXPECT_EQ(at(0.25).piece, 1U);
  EXPECT_EQ(at(0.25).t, 0);
  EXPECT_EQ(at(0.5).t, 0.5);
  EXPECT_EQ(at(0.75).piece, 2U);
  EXPECT_EQ(at(1).piece, 2U);
  EXPECT_EQ(at(1).t, 1);
  EXPECT_EQ(at(-3).t, 0);
  EXPECT_EQ(at(7).piece, 2U);
}

// Lengths that are no powers of two: a joint's parameter times the length is the joint's length
// rounded.
TEST(Chain, WhatIsBeforeABreakpointIsOfThePieceBefore) {
  Chain c{{{0, 0}, 0}, {}, false};
  for (int i = 0; i < 300; ++i)
    c.pieces.push_back({-1, 0.5 + std::fmod(0.618 * i, 1.0), 0.1 + i % 2, 1.1 - i % 2});
  const PlacedChain placed = prepared(c);
  const std::vector<double> at = breakpoints(c);
  ASSERT_EQ(at.size(), 301U);
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_EQ(locate(c, at[i]).piece, i);
    EXPECT_EQ(locate(c, std::nextafter(at[i + 1], 0)).piece, i);
    EXPECT_EQ(locate(placed, at[i]).piece, i);
    EXPECT_EQ(locate(placed, std::nextafter(at[i + 1], 0)).piece, i);
    EXPECT_NEAR(curvature(placed, at[i]), c.pieces[i].curvature_start, 1e-12);
  }
}

TEST(Chain, JointsAreWherePiecesMeet) {
  const Chain c = three();
  const auto poses = joints(c);
  ASSERT_EQ(poses.size(), 4U);
  const auto all = segments(c);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(all[i].start, poses[i]);
    EXPECT_EQ(segment_at(c, i), all[i]);
    const core::Pose2 end = end_pose(all[i]);
    EXPECT_EQ(end, poses[i + 1]);
  }
  EXPECT_EQ(end_pose(c), poses[3]);
}

// Jumps between neighbours, the closing one only of what is closed.
TEST(Chain, JointGapsAreTheLargest) {
  Chain c{{{0, 0}, 0}, {{-1, 1, 1, 2}, {-1, 2, 2.5, 3}, {-1, 1, 2.9, 2}}, false};
  JointGap gap = largest_joint_gap(c);
  EXPECT_NEAR(gap.curvature, 0.5, 1e-14);
  EXPECT_NEAR(gap.curvature_rate, 0.9 + 0.25, 1e-14);  // of clothoids: rates 1, 0.25, -0.9
  c.closed = true;
  gap = largest_joint_gap(c);
  EXPECT_NEAR(gap.curvature, 1, 1e-14);
  EXPECT_NEAR(gap.curvature_rate, 1.9, 1e-14);
}

TEST(Chain, DerivativesAreByTheShareOfTheWhole) {
  const Chain c = three();
  const PlacedChain placed(c);
  for (const double t : {0.1, 0.4, 0.6, 0.9}) {
    constexpr double h = 1e-5;
    const curve::Jet2 j = jet(c, t);
    const core::Point2 up = evaluate(c, t + h), down = evaluate(c, t - h), here = evaluate(c, t);
    EXPECT_NEAR(j.first.x, (up.x - down.x) / (2 * h), 1e-6);
    EXPECT_NEAR(j.first.y, (up.y - down.y) / (2 * h), 1e-6);
    EXPECT_NEAR(j.second.x, (up.x - 2 * here.x + down.x) / (h * h), 2e-4);
    EXPECT_NEAR(core::norm(j.first), 4, 1e-13);
    EXPECT_EQ(evaluate(placed, t), here);
    EXPECT_EQ(jet(placed, t).second, j.second);
    EXPECT_NEAR(curvature(c, t), core::cross(j.first, j.second) / 64, 1e-12);
    EXPECT_NEAR(std::remainder(tangent_angle(c, t) - std::atan2(j.first.y, j.first.x), 2 * kPi), 0,
                1e-13);
    EXPECT_NEAR(curvature_rate(c, t), (curvature(c, t + h) - curvature(c, t - h)) / (8 * h), 1e-5);
  }
  EXPECT_EQ(placed.length(), 4);
}

// A circle by its closed form, and the walk along each piece, which no table goes into.
TEST(Chain, PlacedPiecesOfManyTurnsStandWhereTheyAre) {
  const Chain c{{{3, -2}, 0.4}, {{0.7, 900, 0.2, 2}, {-0.5, 2000, 2, -1}, {3, 700, -1, -1}}, false};
  const PlacedChain placed(c);
  const double whole = arc_length(c);
  for (double t = 0; t <= 1; t += 0.0371) {
    const core::Point2 here = evaluate(placed, t);
    EXPECT_LT(core::distance(here, evaluate(c, t)), 5e-15 * whole) << t;
    EXPECT_EQ(jet(placed, t).point, here);
    EXPECT_EQ(jet(placed, t).third, jet(c, t).third);
  }
  const core::Pose2 joint = segment_at(c, 2).start;
  const core::Point2 centre =
      joint.position - core::perpendicular_left(core::unit_vector(joint.direction));
  EXPECT_NEAR(core::distance(evaluate(placed, 0.95), centre), 1, 5e-15 * whole);
}

TEST(Chain, BreakpointsAreJointsAndInflections) {
  const Chain c = three();
  const auto at = breakpoints(c);
  ASSERT_EQ(at.size(), 5U);
  EXPECT_EQ(at[0], 0);
  EXPECT_EQ(at[1], 0.25);
  EXPECT_EQ(at[2], 0.75);
  // Curvature squared is linear: 9 falls to -0.25.
  EXPECT_NEAR(at[3], 0.75 + 0.25 * 9 / 9.25, 1e-14);
  EXPECT_EQ(at[4], 1);
}

TEST(Chain, SamplesAreEvenAlongIt) {
  const Chain c = three();
  const auto points = sample(c, 9);
  ASSERT_EQ(points.size(), 9U);
  for (int i = 0; i < 9; ++i)
    EXPECT_NEAR(core::distance(points[i], evaluate(c, i / 8.0)), 0, 1e-14) << i;
  EXPECT_THROW(static_cast<void>(sample(c, 1)), core::InvalidInput);
  EXPECT_EQ(sample(c, 2).size(), 2U);
}

TEST(Chain, PartsAreTheSameCurve) {
  const Chain c = three();
  const Chain middle = part(c, 0.1, 0.8);
  EXPECT_EQ(middle.pieces.size(), 3U);
  EXPECT_NEAR(arc_length(middle), 0.7 * 4, 1e-14);
  for (const double t : {0.0, 0.3, 0.7, 1.0}) {
    const core::Point2 meant = evaluate(c, 0.1 + 0.7 * t);
    EXPECT_NEAR(core::distance(evaluate(middle, t), meant), 0, 1e-14) << t;
  }
  // From joint to joint no piece of length 0 is left at either end.
  EXPECT_EQ(part(c, 0.25, 0.75).pieces.size(), 1U);
  EXPECT_EQ(part(c, 0.25, 0.8).pieces.size(), 2U);
  Chain round = c;
  round.closed = true;
  EXPECT_FALSE(part(round, 0, 1).closed);
  const ChainPair halves = split(c, 0.6);
  EXPECT_NEAR(arc_length(halves.first), 2.4, 1e-14);
  EXPECT_NEAR(core::distance(halves.second.start.position, evaluate(c, 0.6)), 0, 1e-14);
}

TEST(Chain, ReversedAndMovedItIsTheSame) {
  Chain c = three();
  c.closed = true;
  const Chain back = reverse(c);
  EXPECT_TRUE(back.closed);
  const core::Similarity2 map{2, 0.7, {3, -1}};
  const Chain moved = transform(c, map);
  EXPECT_TRUE(moved.closed);
  EXPECT_NEAR(arc_length(moved), 8, 1e-14);
  for (const double t : {0.0, 0.3, 0.8, 1.0}) {
    EXPECT_NEAR(core::distance(evaluate(back, 1 - t), evaluate(c, t)), 0, 1e-14);
    EXPECT_NEAR(curvature(back, 1 - t), -curvature(c, t), 1e-13);
    EXPECT_NEAR(core::distance(evaluate(moved, t), core::apply(map, evaluate(c, t))), 0, 1e-13);
  }
}

TEST(Chain, InvalidPiecesAreNamed) {
  EXPECT_FALSE(validate(Chain{}));
  Chain c = three();
  EXPECT_TRUE(validate(c));
  c.pieces[1].length = -1;
  const auto valid = validate(c);
  ASSERT_FALSE(valid);
  EXPECT_EQ(valid.error().path, "pieces[1]");
}

}  // namespace
}  // namespace keyline::lac
