#include "keyline/fairing/calm_run.h"

#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/calm.h"
#include "keyline/lac/chain/chain.h"

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
  auto points = fit_points(lac::sample({{{0, 0}, 0.3}, {{-1, 1, 0.5, 4.5}}, false}, 60));
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

}  // namespace
}  // namespace keyline::fairing::detail
