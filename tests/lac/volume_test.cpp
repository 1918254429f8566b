#include "keyline/lac/hermite/volume.h"

#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Pose2;

TEST(ChordArea, OfArcsIsExact) {
  for (const double angle : {0.01, 1.0, 3.0, 5.0}) {
    const Segment arc{{{3, 1}, 0.4}, 0, angle * 2, 0.5, 0.5};
    EXPECT_NEAR(chord_area(arc), 2 * (angle - std::sin(angle)), 1e-12);
  }
}

TEST(ChordArea, IsAdditive) {
  for (const double alpha : {-2.0, -0.5, 0.0, 1.0, 3.0}) {
    const Segment s{{{1, 2}, 0.1}, alpha, 2, 0.2, 1.4};
    const auto [a, b] = split(s, 0.4);
    const core::Vector2 u = evaluate(s, 0.4) - evaluate(s, 0);
    const core::Vector2 w = evaluate(s, 1) - evaluate(s, 0);
    EXPECT_NEAR(chord_area(s), chord_area(a) + chord_area(b) + 0.5 * cross(u, w), 1e-13);
  }
}

TEST(SolveVolume, GivesBackASegment) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> any(0, 1);
  for (int i = 0; i < 60; ++i) {
    const double alpha = -3 + 6 * any(random);
    const double sign = i % 2 == 0 ? 1 : -1;
    const Segment s{{{1, -2}, 6 * any(random)},
                    alpha,
                    2,
                    sign * (0.1 + 0.7 * any(random)),
                    sign * (0.1 + 0.7 * any(random))};
    const double volume = std::abs(chord_area(s));
    const auto found = solve_volume(s.start, end_pose(s).position, alpha, volume);
    ASSERT_TRUE(found) << alpha << " " << found.error().message;
    const Segment f = segment_at(found->solution.chain, 0);
    EXPECT_NEAR(found->volume, volume, 1e-11 * volume);
    EXPECT_NEAR(std::abs(chord_area(f)), volume, 1e-10 * volume);
    EXPECT_LT(distance(end_pose(f).position, end_pose(s).position), 1e-12);
    EXPECT_NEAR(f.length, 2, 1e-8) << alpha;
    EXPECT_LE(found->reachable.smallest, volume);
  }
}

/// From slope 0 to 1 the least volumes belong to curves whose end curvatures differ by more than
/// doubles hold: the area goes to 0 with the arrival angle b, being less than that of the triangle
/// of both tangents, sin(a) sin(b) / (2 sin(a + b)).
TEST(SolveVolume, ReachesSmallVolumesFromSlopeZeroToOne) {
  for (const double alpha : {0.9999, 1.0, 0.0, 1e-4, 0.99}) {
    const auto s = solve_volume({{0, 0}, 0.7}, {1, 0}, alpha, 1e-5);
    ASSERT_TRUE(s) << alpha << " " << s.error().message;
    EXPECT_NEAR(std::abs(chord_area(s->solution.chain)), 1e-5, 1e-14);
    EXPECT_LT(distance(end_pose(s->solution.chain).position, {1, 0}), 1e-12);
    EXPECT_LT(s->reachable.smallest, 1e-8);
  }
}

TEST(SolveVolume, VolumeGrowsWithTheArrivalAngle) {
  for (const double alpha : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
    double before = 0;
    for (const double volume : {0.1, 0.12, 0.14, 0.16, 0.2, 0.4}) {
      const auto s = solve_volume({{0, 0}, 0.8}, {1, 0}, alpha, volume);
      if (!s) continue;
      EXPECT_GT(std::abs(s->solution.turning), before);
      before = std::abs(s->solution.turning);
    }
    EXPECT_GT(before, 0) << alpha;
  }
}

// Two slopes turn by less than half a circle, and the symmetric curve of a steep start would not.
TEST(SolveVolume, TwoSlopesMayLeaveAcrossTheChordAndBack) {
  const CompoundRhythm rhythm{-1, 1, 0.5};
  for (const double from : {0.5, core::kPi / 2, 1.6, 1.9})
    for (const double share : {0.2, 0.9}) {
      const auto range = solve_volume({{0, 0}, from}, {2, 0}, rhythm, 1e9);
      ASSERT_FALSE(range);
      const std::string& hint = range.error().hint;
      const double largest = std::stod(hint.substr(hint.rfind(' ')));
      const auto found = solve_volume({{0, 0}, from}, {2, 0}, rhythm, share * largest);
      ASSERT_TRUE(found) << from << ' ' << found.error().message;
      const Chain& chain = found->solution.chain;
      EXPECT_LT(distance(end_pose(chain).position, core::Point2{2, 0}), 1e-12);
      EXPECT_NEAR(chain.start.direction, from, 1e-15);
      EXPECT_NEAR(std::abs(chord_area(chain)), share * largest, 1e-8);
    }
  const auto back = solve_volume({{0, 0}, core::kPi}, {2, 0}, rhythm, 1);
  ASSERT_FALSE(back);
  EXPECT_NE(back.error().message.find("straight back"), std::string::npos);
}

TEST(SolveVolume, NamesTheNearestVolume) {
  const auto s = solve_volume({{0, 0}, 0.8}, {1, 0}, 2, 0.0001);
  ASSERT_FALSE(s);
  EXPECT_EQ(s.error().code, ErrorCode::undrawable);
  EXPECT_NE(s.error().hint.find("nearest volume"), std::string::npos);
  const double nearest = std::stod(s.error().hint.substr(15));
  EXPECT_TRUE(solve_volume({{0, 0}, 0.8}, {1, 0}, 2, nearest * 1.0001));
}

// An area: what a chord of one reaches, one of seven reaches 49 times, wherever it lies.
TEST(SolveVolume, WhatIsReachedGrowsAsTheSquareOfTheChord) {
  const core::Vector2 way = 7 * core::unit_vector(2.2);
  for (const double alpha : {-2.0, -1.0, 1.5, 3.0})
    for (const double angle : {-0.8, 0.5, 1.4}) {
      const auto small = solve_volume({{0, 0}, angle}, {1, 0}, alpha, 0.12);
      const auto large =
          solve_volume({{3, -4}, 2.2 + angle}, core::Point2{3, -4} + way, alpha, 49 * 0.12);
      ASSERT_EQ(small.has_value(), large.has_value());
      if (!small) continue;
      EXPECT_NEAR(large->volume, 49 * small->volume, 1e-9);
      EXPECT_NEAR(large->reachable.smallest, 49 * small->reachable.smallest, 1e-9);
      EXPECT_NEAR(large->reachable.largest, 49 * small->reachable.largest,
                  1e-9 * large->reachable.largest);
      // Both ends are reached, and nothing beyond them.
      const VolumeRange range = large->reachable;
      const auto reached = [&](double volume) {
        return solve_volume({{3, -4}, 2.2 + angle}, core::Point2{3, -4} + way, alpha, volume)
            .has_value();
      };
      EXPECT_TRUE(reached(range.largest * (1 - 1e-9)));
      EXPECT_FALSE(reached(range.largest * (1 + 1e-6)));
      EXPECT_TRUE(reached(range.smallest * (1 + 1e-9) + 1e-12));
      EXPECT_FALSE(range.smallest > 1e-9 && reached(range.smallest * (1 - 1e-6)));
    }
}

TEST(SolveVolume, RefusesBadInput) {
  const Pose2 start{{0, 0}, 0.3};
  const auto code = [&](core::Point2 end, double alpha, double volume) {
    return solve_volume(start, end, alpha, volume).error().code;
  };
  EXPECT_EQ(code({0, 0}, -1, 1), ErrorCode::bad_input);
  EXPECT_EQ(code({1, 0}, std::nan(""), 1), ErrorCode::bad_input);
  EXPECT_EQ(code({1, 0}, -1, -1), ErrorCode::bad_input);
  EXPECT_EQ(code({1, 0}, -1, INFINITY), ErrorCode::bad_input);
  EXPECT_TRUE(solve_volume({{0, 0}, 0}, {1, 0}, -1, 0));
  EXPECT_EQ(solve_volume({{0, 0}, 0}, {1, 0}, -1, 1).error().code, ErrorCode::undrawable);
}

TEST(SolveVolume, SlopesThatOverflowAreRefused) {
  for (const double alpha : {-1e300, 1e154, 1e300}) {
    const auto volume = solve_volume({{0, 0}, 0.6}, {2, 0}, alpha, 0.4);
    ASSERT_FALSE(volume) << alpha;
    EXPECT_EQ(volume.error().path, "alpha");
    EXPECT_FALSE(solve_g1({0, 0}, {2, 0}, {3, 1.5}, alpha)) << alpha;
  }
}

}  // namespace
}  // namespace keyline::lac
