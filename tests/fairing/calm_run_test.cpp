#include "keyline/fairing/calm_run.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/calm.h"
#include "keyline/fairing/fair.h"
#include "keyline/lac/chain/chain.h"

#include "truth.h"

/// The whole way of a run.
namespace keyline::fairing::detail {
namespace {

std::vector<FitPoint> fit_points(const std::vector<core::Point2>& points) {
  std::vector<FitPoint> all;
  for (const core::Point2 p : points) all.push_back({.position = p});
  return all;
}

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

}  // namespace
}  // namespace keyline::fairing::detail
