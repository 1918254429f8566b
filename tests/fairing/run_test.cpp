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

}  // namespace
}  // namespace keyline::fairing::detail
