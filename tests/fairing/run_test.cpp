#include "keyline/fairing/run.h"

#include <cmath>
#include <string_view>

#include <gtest/gtest.h>

#include "keyline/fairing/runs.h"
#include "keyline/fairing/shortest_run.h"
#include "keyline/fit/fit_spline.h"
#include "keyline/numeric/random.h"

namespace keyline::fairing::detail {
namespace {

/// Points of half an ellipse, each off by up to `noise` in x and y.
Run half_ellipse(int n, double noise) {
  numeric::Random random(5);
  acquire::KeyLine line;
  for (int i = 0; i < n; ++i) {
    const double t = M_PI * i / (n - 1);
    line.points.push_back({3 * std::cos(t) + noise * random.uniform(-1, 1),
                           std::sin(t) + noise * random.uniform(-1, 1)});
  }
  return run_between(line, 0, line.points.size() - 1);
}

// Errors of a thousandth: within a billionth lies neither the calmest chain nor the shortest, which
// is told, so that nobody looks for them again; within a hundredth the calmest does.
TEST(FairRun, TellsWhereNothingKeepsTheTolerance) {
  const detail::Run run = half_ellipse(81, 1e-3);
  const auto spline = fit::fit_spline(run.points, {}, {}).value();
  for (const double tolerance : {1e-17, 1e-2}) {
    SCOPED_TRACE(tolerance);
    RunOptions options;
    options.tolerance = tolerance;
    options.noise = 1e-3;
    const RunResult solved = fair_run(run, spline.curve, options);
    EXPECT_EQ(solved.missed, tolerance < 1e-3);
    EXPECT_EQ(solved.within_tolerance, tolerance > 1e-3);
    EXPECT_FALSE(solved.calm_missed);
    EXPECT_FALSE(solved.dense.joints.empty());
  }
}

/// The search for the shortest chain tells of itself as it goes on.
int reports_of(const Run& run, RunOptions options) {
  int count = 0;
  options.progress.sink = [&](double, std::string_view) { ++count; };
  fair_run(run, {}, options);
  return count;
}

TEST(FairRun, SeeksTheShortestChainOfARunOnce) {
  detail::Run run = half_ellipse(41, 1e-3);
  FoundBefore before;
  RunOptions options;
  options.criterion = Criterion::fewest_pieces;
  options.tolerance = 1e-2;
  options.noise = 1e-3;
  options.before = &before;
  EXPECT_GT(reports_of(run, options), 0);
  EXPECT_EQ(reports_of(run, options), 0);
  run.tie_end = core::Point2{-3, 0.005};
  EXPECT_GT(reports_of(run, options), 0);
}

/// A run of so many points and a chain of one arc that turns by so much.
bool winds_by(double turn, std::size_t points) {
  detail::Run run;
  run.points.resize(points);
  RunResult result;
  result.fit.joints = {{{}, 0, turn}, {{}, 0, turn}};
  result.fit.pieces = {{.length = 1, .kind = PieceKind::arc}};
  return winds(result, run);
}

// Half a circle from point to point and one more is the most that points can tell.
TEST(Winds, ByMoreThanHalfACircleFromPointToPoint) {
  EXPECT_FALSE(winds_by(3.99 * M_PI, 3));
  EXPECT_TRUE(winds_by(4.01 * M_PI, 3));
  EXPECT_TRUE(winds_by(-4.01 * M_PI, 3));
  EXPECT_FALSE(winds_by(4.01 * M_PI, 4));
}

// Points on a line or an arc are that at sight, unless more is asked of their run.
TEST(FairRun, LinesAndArcsAreSeenAtOnce) {
  acquire::KeyLine line;
  for (int i = 0; i <= 12; ++i)
    line.points.push_back({10 * std::sin(0.1 * i), 10 - 10 * std::cos(0.1 * i)});
  RunOptions options;
  options.tolerance = 1e-3;
  const detail::Run run = run_between(line, 0, 12);
  const RunResult solved = fair_run(run, {}, options);
  EXPECT_TRUE(solved.exact);
  EXPECT_TRUE(solved.within_tolerance);
  EXPECT_EQ(solved.straightened, 1);
  EXPECT_EQ(solved.start_pieces, 1);
  ASSERT_EQ(solved.chain.pieces.size(), 1U);
  EXPECT_NEAR(solved.chain.pieces[0].length, 12, 1e-9);
  EXPECT_NEAR(solved.chain.pieces[0].curvature_start, 0.1, 1e-11);
  detail::Run tied = run;
  tied.tie_end = run.points.back() + core::Vector2{5e-4, 0};
  const RunResult other = fair_run(tied, {}, options);
  EXPECT_EQ(other.straightened, 0);
  EXPECT_NEAR(core::distance(lac::end_pose(other.chain).position, *tied.tie_end), 0, 1e-9);
}

// Five rounded points of an arc, more than a radian apart: one arc, not six pieces that swing.
TEST(FairRun, FewPointsOfAnArcGiveIt) {
  for (const double unit : {1e-4, 1e-2}) {
    acquire::KeyLine line;
    for (int i = 0; i < 5; ++i) {
      const double t = 4.5 * i / 4;
      line.points.push_back(
          {unit * std::round(50 / unit * std::cos(t)), unit * std::round(50 / unit * std::sin(t))});
    }
    RunOptions options;
    options.tolerance = 0.02;
    options.noise = unit / 2;
    const RunResult solved = fair_run(run_between(line, 0, 4), {}, options);
    EXPECT_TRUE(solved.within_tolerance);
    ASSERT_EQ(solved.chain.pieces.size(), 1U) << unit;
    EXPECT_NEAR(solved.chain.pieces[0].curvature_start, 0.02, 1e-3 * unit);
    EXPECT_NEAR(solved.chain.pieces[0].length, 225, 10 * unit);
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
