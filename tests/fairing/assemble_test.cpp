#include "keyline/fairing/assemble.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/reading.h"

/// The answer put together.
namespace keyline::fairing::detail {
namespace {

/// The line from (0, 0) to (10, 0) as a spline.
curve::BSpline2 straight() {
  curve::BSpline2 spline;
  spline.knots = {0, 0, 0, 0, 1, 1, 1, 1};
  for (int i = 0; i < 4; ++i) spline.control.push_back({10.0 * i / 3, 0});
  return spline;
}

TEST(PointsInRegion, AreThoseBetweenSharesOfTheLength) {
  std::vector<core::Point2> points;
  for (int i = 0; i <= 10; ++i) points.push_back({1.0 * i, 0.1});
  const RegionPoints part = points_in_region(points, false, {0.25, 0.71}, straight());
  EXPECT_EQ(part.first, 3U);
  EXPECT_EQ(part.last, 7U);
  EXPECT_NEAR(part.t_first, 0.3, 1e-8);
  EXPECT_NEAR(part.t_last, 0.7, 1e-8);
  const RegionPoints all = points_in_region(points, false, {0, 1}, straight());
  EXPECT_EQ(all.first, 0U);
  EXPECT_EQ(all.last, 10U);
  EXPECT_EQ(all.t_first, 0);
  EXPECT_EQ(all.t_last, 1);
  // At a point's very place it belongs to either side.
  const RegionPoints at = points_in_region(points, false, {0.3, 0.7}, straight());
  EXPECT_EQ(at.first, 3U);
  EXPECT_EQ(at.last, 7U);
}

// A square of 1: its whole length has the closing side too.
TEST(PointsInRegion, OfClosedLinesCountTheClosingSide) {
  const std::vector<core::Point2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const RegionPoints part = points_in_region(square, true, {0.2, 0.8}, straight());
  EXPECT_EQ(part.first, 1U);
  EXPECT_EQ(part.last, 3U);
  const RegionPoints open = points_in_region(square, false, {0.2, 0.8}, straight());
  EXPECT_EQ(open.first, 1U);
  EXPECT_EQ(open.last, 2U);
}

TEST(MeasureDeviation, IsOfTheOffsets) {
  FairResult result;
  result.offsets = {0.1, -0.5, 0.3, 0.5};
  result.tolerance = 0.5;
  measure_deviation(result);
  EXPECT_EQ(result.max_deviation, 0.5);
  EXPECT_EQ(result.worst_point, 1U);
  EXPECT_NEAR(result.rms_deviation, std::sqrt((0.01 + 0.25 + 0.09 + 0.25) / 4), 1e-15);
  EXPECT_TRUE(result.within_tolerance);
  result.tolerance = 0.499;
  measure_deviation(result);
  EXPECT_FALSE(result.within_tolerance);
}

/// A solved run of two straight pieces along x, in its own frame, points on and beside them.
struct Solved {
  Run run;
  RunResult result;
};
Solved solved() {
  Solved s;
  s.run.points = {{0, 0.1}, {3, -0.2}, {5, 0.3}, {10, 0}};
  s.run.index = {4, 5, 6, 7};
  s.run.length = 10;
  s.result.chain = {{{0, 0}, 0}, {{-1, 4, 0, 0}, {-1, 6, 0, 0}}, false};
  s.result.fit.feet = {{0, 0.1}, {0, 0.7}, {1, 0.2}, {1, 0.9}};
  s.result.point_of = {0, 1, 2, 3};
  return s;
}

TEST(PlacePoints, AreFeetOnTheChainAsLaidOut) {
  Solved s = solved();
  const auto places = place_points(s.result, s.run);
  ASSERT_EQ(places.size(), 4U);
  EXPECT_NEAR(places[0].offset, 0.1, 1e-12);
  EXPECT_NEAR(places[1].offset, -0.2, 1e-12);
  EXPECT_EQ(places[1].piece, 0);
  EXPECT_NEAR(places[1].fraction, 0.75, 1e-12);
  EXPECT_EQ(places[2].piece, 1);
  EXPECT_NEAR(places[2].fraction, 1 / 6.0, 1e-12);
  EXPECT_NEAR(places[3].fraction, 1, 1e-12);
}

// Solved the other way round feet are counted from the other end.
TEST(PlacePoints, OfReversedRunsFeetStartFromTheOtherEnd) {
  Solved s = solved();
  s.result.reversed = true;
  s.result.fit.feet = {{1, 0.9}, {1, 0.3}, {0, 0.8}, {0, 0.1}};
  const auto places = place_points(s.result, s.run);
  EXPECT_EQ(places[1].piece, 0);
  EXPECT_NEAR(places[1].fraction, 0.75, 1e-12);
  EXPECT_EQ(places[2].piece, 1);
}

TEST(AddRun, AddsPiecesAndOffsets) {
  Solved s = solved();
  FairResult result;
  result.offsets.assign(9, 0);
  result.offsets[4] = -0.7;  // a corner's point, farther from the chain before
  add_run(result, s.result, s.run, 2, 100, {});
  ASSERT_EQ(result.pieces.size(), 2U);
  EXPECT_EQ(result.pieces[0].curve, 2);
  EXPECT_EQ(result.pieces[0].start, 100);
  EXPECT_EQ(result.pieces[1].start, 104);
  EXPECT_NEAR(result.pieces[0].deviation, 0.2, 1e-12);
  EXPECT_NEAR(result.pieces[1].deviation, 0.3, 1e-12);
  EXPECT_EQ(result.offsets[4], -0.7);
  EXPECT_NEAR(result.offsets[5], -0.2, 1e-12);
  EXPECT_NEAR(result.offsets[6], 0.3, 1e-12);
  EXPECT_EQ(result.offsets[8], 0);
}

// Kept parts before and behind: curves move on by one, joints between them are told.
TEST(Assemble, KeptPartsStandAroundTheChains) {
  FairResult result;
  result.pieces.resize(1);
  RunResult run;
  run.chain = {{{10, 0}, 0}, {{-1, 4, 0, 0.5}, {-1, 6, 0.5, 0.5}}, false};
  assemble(result, {run}, {straight(), {}});
  ASSERT_EQ(result.curves.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<curve::BSpline2>(result.curves[0]));
  EXPECT_EQ(result.pieces[0].curve, 1);
  EXPECT_EQ(result.joints.size(), 2U);  // inside the chain, and between the spline and it
  FairResult alone;
  alone.pieces.resize(1);
  assemble(alone, {run}, {});
  EXPECT_EQ(alone.pieces[0].curve, 0);
  EXPECT_EQ(alone.joints.size(), 1U);
  FairResult before;
  assemble(before, {run, run}, {{}, {}, straight()});
  EXPECT_EQ(before.curves.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<curve::BSpline2>(before.curves[2]));
  EXPECT_EQ(before.joints.size(), 4U);
}

TEST(NoteRun, TellsWhatBecameOfIt) {
  RunResult run = solved().result;
  run.start_pieces = 9;
  const auto notes = [&] {
    FairResult result;
    note_run(result, run, 3, 4);
    return result.notes;
  };
  ASSERT_EQ(notes().size(), 1U);
  EXPECT_EQ(notes()[0], "run 3: 2 pieces, merged from 9");
  FairResult lone;
  note_run(lone, run, 0, 1);
  EXPECT_EQ(lone.notes[0], "2 pieces, merged from 9");
  run.dense.joints.resize(2);
  EXPECT_EQ(notes()[0], "run 3: 2 pieces, read off the graph of curvature");
  const auto last_has = [&](const char* text) {
    return notes().size() == 2 && notes()[1].find(text) != std::string::npos;
  };
  run.exact = true;
  EXPECT_TRUE(last_has("reproduced to rounding"));
  run.exact = false;
  run.calm_missed = true;
  EXPECT_TRUE(last_has("the shortest one is given"));
  run.calm_missed = false;
  run.waves.untried = true;
  EXPECT_TRUE(last_has("some stay"));
  run.waves.untried = false;
  run.straightened = 1;
  EXPECT_TRUE(last_has("1 piece is an exact line or arc"));
}

// Along a spline whose parameter runs unevenly (x = 10 t + 3 t (1 - t) (1 - 2 t)) a point's foot is
// not where its share of the length says: the places where x is met, by Newton's method here.
TEST(PointsInRegion, FeetAreWhereTheSplineIsNearest) {
  curve::BSpline2 spline = straight();
  spline.control = {{0, 0}, {13 / 3.0, 0}, {17 / 3.0, 0}, {10, 0}};
  std::vector<core::Point2> points;
  for (int i = 0; i <= 40; ++i) points.push_back({0.25 * i, -0.2});
  const auto at = [](double x) {
    double t = x / 10;
    for (int i = 0; i < 50; ++i)
      t -= (10 * t + 3 * t * (1 - t) * (1 - 2 * t) - x) / (10 + 3 * (1 - 6 * t + 6 * t * t));
    return t;
  };
  for (const auto& [low, high] : {std::pair{0.25, 0.75}, {0.125, 0.95}, {0.3, 0.6}}) {
    const RegionPoints part = points_in_region(points, false, {low, high}, spline);
    EXPECT_NEAR(part.t_first, at(0.25 * double(part.first)), 2e-9);
    EXPECT_NEAR(part.t_last, at(0.25 * double(part.last)), 2e-9);
    EXPECT_GT(std::abs(part.t_first - 0.025 * double(part.first)), 0.01);
  }
}

// The last point of a closed line is no end: its foot is looked for.
TEST(PointsInRegion, TheLastPointOfAClosedLineHasAFoot) {
  std::vector<core::Point2> points;
  for (int i = 0; i < 9; ++i) points.push_back({1.0 * i, 0});
  points.push_back({9, 0.5});
  const RegionPoints closed = points_in_region(points, true, {0.2, 1}, straight());
  EXPECT_EQ(closed.last, 9U);
  EXPECT_LT(closed.t_last, 0.91);
  EXPECT_EQ(points_in_region(points, false, {0.2, 1}, straight()).t_last, 1);
}

/// A run of one clothoid that leaves its arc by 0.0014, and points on it or beside it by turns.
Solved bow(int points, double off) {
  Solved s;
  s.result.chain = {{{0, 0}, 0}, {{-1, 1, 0.5, 0.7}}, false};
  for (int j = 0; j < points; ++j) {
    const double t = (j + 0.5) / points;
    const core::Pose2 at = lac::pose_at(lac::segments(s.result.chain)[0], t);
    const core::Vector2 left = core::perpendicular_left(core::unit_vector(at.direction));
    s.run.points.push_back(at.position + (j % 2 == 0 ? off : -off) * left);
    s.run.index.push_back(static_cast<std::size_t>(j));
    s.result.fit.feet.push_back({0, t});
    s.result.point_of.push_back(static_cast<std::size_t>(j));
  }
  s.run.length = 1;
  return s;
}

// Errors of 0.01 do not tell the slope, whether they are known or the offsets show them; nor do
// four points.
TEST(AddRun, PiecesAreReadWithTheErrorsThatThereAre) {
  const auto told = [](int points, double off, double noise) {
    const Solved s = bow(points, off);
    FairResult result;
    result.noise = noise;
    result.offsets.assign(s.run.points.size(), 0);
    add_run(result, s.result, s.run, 0, 0, {});
    read_pieces(result.pieces, s.result.chain);
    return result.pieces[0].told;
  };
  EXPECT_TRUE(told(20, 1e-6, 1e-6));
  EXPECT_FALSE(told(20, 1e-2, 1e-6));
  EXPECT_FALSE(told(20, 1e-6, 1e-2));
  EXPECT_FALSE(told(4, 1e-6, 1e-6));
}

TEST(Assemble, LengthsAddUpAndSeamsOfWholesAreJoints) {
  RunResult run;
  run.chain = {{{10, 0}, 0}, {{-1, 4, 0, 0.5}, {-1, 6, 0.5, 0.5}}, false};
  FairResult result;
  result.length = 99;
  assemble(result, {run}, {straight(), {}, straight()});
  EXPECT_NEAR(result.length, 30, 1e-9);
  EXPECT_EQ(result.curves.size(), 3U);
  EXPECT_EQ(result.joints.size(), 3U);  // one inside, two between
  FairResult closed;
  closed.closed = true;
  assemble(closed, {run, run}, {});
  EXPECT_EQ(closed.joints.size(), 4U);  // one inside either, two between
  // Of one chain that is closed its own seam.
  run.chain.closed = true;
  FairResult one;
  one.closed = true;
  assemble(one, {run}, {});
  EXPECT_EQ(one.joints.size(), 2U);
  EXPECT_EQ(one.joint_rates.g3 + one.joint_rates.turns + one.joint_rates.jumps, 2);
}

// Told where no run has a calmest chain and one of them was looked for and missed.
TEST(Assemble, CalmIsMissedWhereNoRunHasIt) {
  RunResult other;
  other.chain = {{{0, 0}, 0}, {{-1, 4, 0, 0.5}}, false};
  RunResult missed = other, calm = other;
  missed.calm_missed = true;
  calm.dense.joints.resize(2);
  const auto told = [](const std::vector<RunResult>& runs) {
    FairResult result;
    assemble(result, runs, {});
    return result.calm_missed;
  };
  EXPECT_FALSE(told({other, other}));
  EXPECT_TRUE(told({other, missed}));
  EXPECT_FALSE(told({calm, missed}));
  EXPECT_FALSE(told({calm, other}));
}

}  // namespace
}  // namespace keyline::fairing::detail
