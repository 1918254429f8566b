#include "keyline/fairing/calm_run.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/fairing/fair.h"
#include "keyline/lac/chain/chain.h"

#include "fit_points.h"
#include "truth.h"

/// The whole way of a run.
namespace keyline::fairing::detail {
namespace {

// Points of one clothoid: the cells that it is followed in are never its pieces.
TEST(CalmRun, StoppedAtItsStartIsOfFewPiecesToo) {
  auto points = fit_points(lac::sample(lac::Chain{{{0, 0}, 0.3}, {{-1, 1, 0.5, 4.5}}, false}, 60));
  CalmRunOptions options;
  options.tolerance = 1e-3;
  const CalmRun whole = solve_calm(points, false, options);
  EXPECT_TRUE(whole.band.within);
  EXPECT_LE(whole.curve.alpha.size(), 4U);
  options.progress.cancellation = core::CancellationToken::make();
  options.progress.cancellation.request_stop();
  const CalmRun stopped = solve_calm(points, false, options);
  EXPECT_LE(stopped.curve.alpha.size(), 4U);
}

// Errors of 160 points within their own size make a wave of every few of them, more than are
// tried one by one; within four times their size there are few.
TEST(CalmRun, WavesThatWereNotTriedAreTold) {
  const lac::Chain bow{{{0, 0}, 0.2}, {{-1, 40, 0.005, 0.04}, {0.8, 35, 0.04, 0.01}}, false};
  const acquire::KeyLine line = testing::line_through(testing::measure(bow, 160, 2e-4, 3));
  FairOptions options;
  const auto told = [&] {
    const FairResult result = fair(line, options).value();
    return std::ranges::any_of(result.notes, [](const std::string& note) {
      return note.find("more waves of curvature than can be tried") != std::string::npos;
    });
  };
  EXPECT_FALSE(told());
  options.tolerance = line.noise;
  EXPECT_TRUE(told());
}

// Four pieces each: as many and one or two more have too large a mean square, and have it taken
// down by springs stiff enough; by springs made stiffer at a guess it took seven and nine pieces.
TEST(CalmRun, SpringsKeepFewPiecesNearEnough) {
  for (const int seed : {1, 7}) {
    const lac::Chain truth = testing::random_chain(seed);
    ASSERT_EQ(truth.pieces.size(), 4U);
    const auto line = testing::line_through(testing::measure(truth, 200, 5e-4, seed));
    EXPECT_LE(fair(line, {}).value().pieces.size(), 6U) << seed;
  }
}

/// Two pieces of a length of 2: a clothoid to the left, an arc, in four even cells.
DenseCurve two_pieces() {
  DenseCurve curve;
  curve.at = {0, 0.25, 0.5, 0.75, 1};
  for (int i = 0; i <= 4; ++i) curve.joints.push_back({{0.5 * i, 1}, 0.1 * i, 99});
  curve.cut = {0, 2, 4};
  curve.value = {1, 3, 3.2};
  curve.alpha = {-0.6, -1};
  curve.kind = {PieceKind::curve, PieceKind::arc};
  curve.length = 2;
  curve.feet = {{0, 0}, {1, 0.5}, {2, 0}, {3, 0.25}, {3, 1}};
  return curve;
}

TEST(ChainOf, IsTheSamePieces) {
  const FitChain chain = chain_of(two_pieces());
  ASSERT_EQ(chain.pieces.size(), 2U);
  ASSERT_EQ(chain.joints.size(), 3U);
  EXPECT_FALSE(chain.closed);
  EXPECT_TRUE(chain.first_at_start && chain.last_at_end);
  EXPECT_EQ(chain.pieces[0].length, 1);
  EXPECT_EQ(chain.pieces[1].length, 1);
  EXPECT_EQ(chain.pieces[0].alpha, -0.6);
  EXPECT_EQ(chain.pieces[0].kind, PieceKind::curve);
  EXPECT_EQ(chain.pieces[1].kind, PieceKind::arc);
  EXPECT_EQ(chain.joints[0].curvature, 0.5);            // of a length of 2
  EXPECT_NEAR(chain.joints[1].curvature, 1.55, 1e-15);  // one on the whole arc
  EXPECT_EQ(chain.joints[2].curvature, chain.joints[1].curvature);
  EXPECT_EQ(chain.joints[1].position, (core::Point2{1, 1}));
  EXPECT_EQ(chain.joints[1].direction, 0.2);
  const std::vector<int> piece{0, 0, 1, 1, 1};
  const std::vector<double> fraction{0, 0.75, 0, 0.625, 1};
  ASSERT_EQ(chain.feet.size(), 5U);
  for (std::size_t j = 0; j < 5; ++j) {
    EXPECT_EQ(chain.feet[j].piece, piece[j]) << j;
    EXPECT_NEAR(chain.feet[j].fraction, fraction[j], 1e-15) << j;
  }
}

// A held end is where it is held, as much of it as is.
TEST(ChainOf, HeldEndsAreToTheLastDigit) {
  for (const Hold hold : {Hold::free, Hold::position, Hold::direction, Hold::curvature})
    for (const bool slides : {false, true}) {
      DenseCurve curve = two_pieces();
      curve.kind.clear();
      curve.hold_start = curve.hold_end = hold;
      curve.slides_start = curve.slides_end = slides;
      curve.held_start = {{0.01, 1.01}, 0.02, 0.7};
      curve.held_end = {{2.01, 1.02}, 0.5, 1.7};
      const FitChain chain = chain_of(curve);
      EXPECT_EQ(chain.hold_start, hold);
      EXPECT_EQ(chain.hold_end, hold);
      const FitJoint &first = chain.joints.front(), &last = chain.joints.back();
      const bool at = hold >= Hold::position;
      EXPECT_EQ(first.position, (core::Point2{at && !slides ? 0.01 : 0, at ? 1.01 : 1}));
      EXPECT_EQ(last.position, (core::Point2{at && !slides ? 2.01 : 2, at ? 1.02 : 1}));
      EXPECT_EQ(first.direction, hold >= Hold::direction ? 0.02 : 0);
      EXPECT_EQ(last.direction, hold >= Hold::direction ? 0.5 : 0.4);
      EXPECT_EQ(first.curvature, hold >= Hold::curvature ? 0.7 : 0.5);
      EXPECT_EQ(last.curvature, hold >= Hold::curvature ? 1.7 : 1.6);
    }
}

TEST(ChainOf, ClosedCurvesAreNotPinned) {
  DenseCurve curve = two_pieces();
  curve.closed = true;
  curve.turning = 6;
  const FitChain chain = chain_of(curve);
  EXPECT_TRUE(chain.closed);
  EXPECT_FALSE(chain.first_at_start || chain.last_at_end);
  EXPECT_EQ(chain.turning, 6);
}

/// A clothoid in cells, and points on it.
struct Clothoid {
  DenseCurve curve;
  std::vector<FitPoint> points;
  lac::Chain chain{{{0.4, -0.3}, 0.3}, {{-1, 0.8, 0.5, 2.5}}, false};

  Clothoid() {
    for (int i = 0; i <= 40; ++i) {
      const double t = i / 40.0;
      curve.at.push_back(t);
      curve.joints.push_back(
          {lac::evaluate(chain, t), lac::tangent_angle(chain, t), lac::curvature(chain, t)});
      points.push_back({.position = curve.joints.back().position});
      curve.feet.push_back(i < 40 ? Foot{i, 0} : Foot{39, 1});
    }
    curve.length = lac::arc_length(chain);
    set_free(curve);
  }
};

// Held a little beside themselves ends go there, a turn more or less being none.
TEST(HoldEnds, EndsComeToWhereTheyAreHeld) {
  for (const Hold hold : {Hold::position, Hold::direction, Hold::curvature})
    for (const bool at_start : {false, true}) {
      Clothoid c;
      FitJoint joint = at_start ? c.curve.joints.front() : c.curve.joints.back();
      joint.position = joint.position + core::Vector2{2e-4, -1e-4};
      joint.direction += 2e-4;
      joint.curvature += 0.01;
      HeldEnd held{hold, joint};
      held.joint.direction += 4 * core::kPi;
      const BandReport found = hold_ends(c.curve, c.points, 1e-3, 0, at_start ? held : HeldEnd{},
                                         at_start ? HeldEnd{} : held);
      EXPECT_TRUE(found.within);
      EXPECT_LE(found.max_offset, 1e-3);
      const FitChain chain = chain_of(c.curve);
      const FitJoint& now = at_start ? chain.joints.front() : chain.joints.back();
      EXPECT_NEAR(core::distance(now.position, joint.position), 0, 1e-12);
      const double turn = std::abs(now.direction - joint.direction);
      const double bend = std::abs(now.curvature - joint.curvature);
      EXPECT_EQ(turn < 1e-12, hold >= Hold::direction) << turn;
      EXPECT_EQ(bend < 1e-12, hold >= Hold::curvature) << bend;
      // So does the curve it is made of, which was solved for.
      const FitJoint& own = at_start ? c.curve.joints.front() : c.curve.joints.back();
      const double value = at_start ? c.curve.value.front() : c.curve.value.back();
      EXPECT_NEAR(core::distance(own.position, joint.position), 0, 1e-9);
      EXPECT_EQ(std::abs(own.direction - joint.direction) < 1e-9, hold >= Hold::direction);
      EXPECT_EQ(std::abs(value / c.curve.length - joint.curvature) < 1e-3, hold >= Hold::curvature);
      const FitJoint& other = at_start ? c.curve.joints.back() : c.curve.joints.front();
      EXPECT_LT(core::distance(other.position,
                               at_start ? c.points.back().position : c.points.front().position),
                1.5e-3);
    }
}

// A sliding end keeps its own x, wherever that of what holds it is.
TEST(HoldEnds, SlidingEndsMoveAlongTheirLine) {
  for (const bool at_start : {false, true}) {
    Clothoid c;
    const FitJoint own = at_start ? c.curve.joints.front() : c.curve.joints.back();
    HeldEnd held{Hold::position, own, true};
    held.joint.position = own.position + core::Vector2{0.5, 2e-4};
    const BandReport found = hold_ends(c.curve, c.points, 1e-3, 0, at_start ? held : HeldEnd{},
                                       at_start ? HeldEnd{} : held);
    EXPECT_TRUE(found.within);
    const FitChain chain = chain_of(c.curve);
    const FitJoint& now = at_start ? chain.joints.front() : chain.joints.back();
    EXPECT_NEAR(now.position.x, own.position.x, 0.1);
    EXPECT_NEAR(now.position.y, own.position.y + 2e-4, 1e-12);
    const FitJoint& dense = at_start ? c.curve.joints.front() : c.curve.joints.back();
    EXPECT_NEAR(dense.position.y, own.position.y + 2e-4, 1e-9);
  }
}

// Means that are off the curve by turns, of two points beside each, before and behind it along the
// curve: the spread is theirs from the mean, at right angles to the curve.
TEST(CalmRun, SpreadIsThatOfThePointsBesideTheirMean) {
  const lac::Chain chain{{{0, 0}, 0.3}, {{-1, 1, 0.5, 2.5}}, false};
  std::vector<FitPoint> points;
  CalmRunOptions options;
  options.tolerance = 4e-3;
  for (int i = 0; i <= 40; ++i) {
    const double t = i / 40.0, off = i % 2 == 0 ? 5e-4 : -5e-4;
    const auto beside = [&](double place, double left) {
      place = std::clamp(place, 0.0, 1.0);
      const double angle = lac::tangent_angle(chain, place) + core::kPi / 2;
      return lac::evaluate(chain, place) + (off + left) * core::unit_vector(angle);
    };
    const bool alone = i == 20;  // no mean: its spread is not measured
    const double spread = alone ? 1e-5 : 3e-3;
    points.push_back(
        {.position = beside(t, 0), .low = -spread, .high = spread, .count = alone ? 1.0 : 2});
    if (alone) continue;
    for (const double side : {1.0, -1.0}) {
      options.members.points.push_back(beside(t + 0.03 * side, side > 0 ? 2e-3 : -1e-3));
      options.members.fitted.push_back(points.size() - 1);
    }
  }
  solve_calm(points, false, options);
  EXPECT_EQ(points[20].low, -1e-5);
  EXPECT_EQ(points[20].high, 1e-5);
  for (std::size_t f = 0; f < points.size(); ++f) {
    if (f == 20) continue;
    const double beside =
        f < 4 || f + 4 >= points.size() ? 4e-4 : 2e-4;  // the curve is freer there
    EXPECT_NEAR(points[f].low, -1e-3, beside) << f;
    EXPECT_NEAR(points[f].high, 2e-3, beside) << f;
  }
}

// Whose members nobody gave keep the spread they came with.
TEST(CalmRun, SpreadOfMeansWithoutMembersStays) {
  auto points = fit_points(lac::sample(lac::Chain{{{0, 0}, 0.3}, {{-1, 1, 0.5, 2.5}}, false}, 40));
  for (FitPoint& point : points) point.count = 2, point.low = -2e-4, point.high = 3e-4;
  CalmRunOptions options;
  options.tolerance = 1e-3;
  EXPECT_TRUE(solve_calm(points, false, options).band.within);
  for (const FitPoint& point : points) {
    EXPECT_EQ(point.low, -2e-4);
    EXPECT_EQ(point.high, 3e-4);
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
