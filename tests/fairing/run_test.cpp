#include "keyline/fairing/run.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/fairing/runs.h"
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

}  // namespace
}  // namespace keyline::fairing::detail
