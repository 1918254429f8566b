#include "keyline/fairing/solve_runs.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/runs.h"

/// Splines and chains of all runs together.
namespace keyline::fairing::detail {
namespace {

/// Points of an arc of radius and length 1, which no search is needed for.
Run arc(int n, double height) {
  acquire::KeyLine line;
  for (int i = 0; i < n; ++i) {
    const double t = i / (n - 1.0);
    line.points.push_back({std::sin(t), height + 1 - std::cos(t)});
  }
  return run_between(line, 0, line.points.size() - 1);
}

TEST(FitOf, IsForTheRunsOwnPoints) {
  detail::Run run = arc(20, 0);
  run.must_pass = {3, 5};
  fit::SplineFitOptions all;
  all.order = 6;
  EXPECT_EQ(fit_of(run, all).order, 6);
  EXPECT_EQ(fit_of(run, all).must_pass, run.must_pass);
  EXPECT_FALSE(fit_of(run, all).closed);
  run.closed = true;
  EXPECT_TRUE(fit_of(run, all).closed);
  run.points.resize(9);
  EXPECT_TRUE(fit_of(run, all).closed);
  run.points.resize(8);  // too few for a closed spline
  EXPECT_FALSE(fit_of(run, all).closed);
  run.points.resize(5);
  EXPECT_EQ(fit_of(run, all).order, 5);
  all.order = 4;
  EXPECT_EQ(fit_of(run, all).order, 4);
}

// Chain and spline of every run in its place, each sought once; the progress of all goes from 0 to
// 1 and never back.
TEST(SolveRuns, EveryRunHasItsSplineAndItsChain) {
  const std::vector<detail::Run> runs{arc(60, 0), arc(7, 1), arc(80, 2)};
  std::vector<double> told;
  core::Progress progress;
  progress.sink = [&](double fraction, std::string_view) { told.push_back(fraction); };
  fit::SplineFitOptions fit = fit::SplineFitOptions::for_fairing();
  fit.threads = 1;
  RunOptions options;
  options.tolerance = 1e-3;
  options.threads = 1;
  int chains = 0;
  const OptionsOf options_of = [&](std::size_t) {
    ++chains;
    return options;
  };
  const auto solved = solve_runs(runs, {}, fit, options_of, progress).value();
  ASSERT_EQ(solved.size(), 3U);
  EXPECT_EQ(chains, 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double height = static_cast<double>(k);
    EXPECT_NEAR(evaluate(solved[k].spline, 0).y, height, 1e-6);
    EXPECT_NEAR(solved[k].chain.chain.start.position.y, height, 1e-12);
    EXPECT_NEAR(lac::arc_length(solved[k].chain.chain), 1, 1e-12);
    EXPECT_NE(solved[k].bic, 0);
  }
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_GE(told.front(), 0);
  EXPECT_LE(told.back(), 1);
  EXPECT_GT(told.back(), 0.3);  // splines are two fifths; these chains tell of nothing
  EXPECT_LT(told.back(), 0.45);
}

// Splines that are known are taken as they are.
TEST(SolveRuns, KnownSplinesAreTaken) {
  curve::BSpline2 spline;
  spline.knots = {0, 0, 0, 0, 1, 1, 1, 1};
  spline.control = {{0, 5}, {1, 6}, {2, 7}, {3, 8}};
  RunOptions options;
  options.tolerance = 1e-3;
  const std::vector<detail::Run> runs{arc(9, 0)};
  const auto solved =
      solve_runs(runs, {spline}, {}, [&](std::size_t) { return options; }, {}).value();
  EXPECT_EQ(solved[0].spline.control[2].y, 7);
  EXPECT_EQ(solved[0].bic, 0);
}

}  // namespace
}  // namespace keyline::fairing::detail
