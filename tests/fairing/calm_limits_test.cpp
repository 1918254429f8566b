#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/calm_run.h"
#include "keyline/fairing/fair.h"
#include "keyline/lac/chain/chain.h"

#include "fit_points.h"
#include "truth.h"

/// What the whole way of a run has to keep, whatever it is given: the tolerance, the mean square,
/// the energy, and where those leave no choice.
namespace keyline::fairing::detail {
namespace {

/// 80 points of a random chain with errors of `noise`, the length as the unit.
std::vector<FitPoint> measured(int seed, double noise) {
  const lac::Chain truth = testing::random_chain(static_cast<std::uint64_t>(seed));
  const double length = lac::arc_length(truth);
  std::vector<FitPoint> points;
  for (const core::Point2 p : testing::measure(truth, 80, noise, seed))
    points.push_back({.position = {p.x / length, p.y / length}});
  return points;
}

CalmRun solved(std::vector<FitPoint>& points, double noise, double tolerance,
               CalmRunOptions options = {}) {
  options.tolerance = tolerance;
  options.arcs = false;  // which may cost once more what pieces may
  if (noise > 0)
    options.residuals = allowed_residuals(points, false, points.size(), noise, tolerance, 0.5);
  return solve_calm(points, false, options);
}

// Every curve within a tolerance is within a larger one: the least variation falls, by far more
// than the accuracy of the solver where the tolerance is what the errors are.
TEST(CalmLimits, ALargerToleranceCostsNoMoreVariation) {
  for (const int seed : {3, 12}) {
    double before = HUGE_VAL, calm_before = HUGE_VAL;
    for (const double tolerance : {6e-4, 8e-4, 1e-3}) {
      std::vector<FitPoint> points = measured(seed, 5e-4);
      const CalmRun run = solved(points, 0, tolerance);
      ASSERT_TRUE(run.band.within) << seed << ", " << tolerance;
      const FitChain chain = chain_of(run.curve);
      for (const double off : offsets(chain, points)) EXPECT_LE(std::abs(off), 1.001 * tolerance);
      EXPECT_LT(run.band.energy, before) << seed << ", " << tolerance;
      EXPECT_LT(run.calm_energy, calm_before) << seed << ", " << tolerance;
      before = run.band.energy;
      calm_before = run.calm_energy;
    }
  }
}

// Pieces may cost a twentieth more than the calm curve: of these chains every one has fewer that
// cost more. The tolerance alone counts, or errors too.
TEST(CalmLimits, PiecesLoseATwentiethOfTheEnergyAtMost) {
  for (const int seed : {1, 25, 54}) {
    std::vector<FitPoint> points = measured(seed, 5e-4);
    const CalmRun run = solved(points, 0, 1.2e-3);
    EXPECT_TRUE(run.band.within) << seed;
    EXPECT_LE(run.band.energy, 1.05 * run.calm_energy) << seed;
  }
  for (const int seed : {12, 19, 29}) {
    std::vector<FitPoint> points = measured(seed, 5e-4);
    const CalmRun run = solved(points, 5e-4, noise_factor(80) * 5e-4);
    EXPECT_TRUE(run.band.within) << seed;
    EXPECT_LE(run.band.energy, 1.05 * run.calm_energy) << seed;
  }
}

// Where errors count, the root of the offsets' mean square is expected to be theirs and a standard
// error more, and may be five more: of 80 errors each is a share of 1 / sqrt(160).
TEST(CalmLimits, PiecesKeepTheMeanSquareOfTheErrors) {
  const double error = 1 / std::sqrt(160.0);
  for (const int seed : {1, 3, 5, 9, 34}) {
    std::vector<FitPoint> points = measured(seed, 5e-4);
    const CalmRun run = solved(points, 5e-4, noise_factor(80) * 5e-4);
    EXPECT_TRUE(run.band.within) << seed;
    double square = 0;
    for (const double off : offsets(chain_of(run.curve), points)) square += off * off;
    EXPECT_LE(std::sqrt(square / 80), 5e-4 * (1 + error) * (1 + 5 * error)) << seed;
    EXPECT_NEAR(std::sqrt(square / 80), run.band.rms, 1e-3 * run.band.rms) << seed;
  }
}

// A bump on points without errors. Without its wave the offsets are so many standard errors, a
// tenth of what is expected each, above that: up to four it goes.
TEST(CalmLimits, WavesStayThatFourStandardErrorsDoNotExplain) {
  for (const auto& [height, errors] : {std::pair{2.15e-3, 3}, {2.25e-3, 4}}) {
    std::vector<FitPoint> points;
    for (int i = 0; i <= 60; ++i) {
      const double x = i / 60.0, s = (x - 0.5) / 0.12;
      points.push_back({.position = {x, 0.3 * x * x + height * std::exp(-s * s)}});
    }
    CalmOptions without;
    without.band.tolerance = 0.9 * 5e-3;
    without.band.rms = 2e-4;
    without.worth = kWaveWorth;
    DenseCurve calmest = dense_curve(points, false, 240);
    const Calmed calmed = calm(calmest, points, without);
    ASSERT_EQ(calmed.waves.turns, 0);
    ASSERT_GT(calmed.band.rms, 2e-4 * (1 + 0.1 * errors));
    ASSERT_LT(calmed.band.rms, 2e-4 * (1 + 0.1 * (errors + 1)));
    CalmRunOptions options;
    options.tolerance = 5e-3;
    options.residuals = {.rms = 2e-4, .noise = 2e-4, .standard_error = 0.1};
    const CalmRun run = solve_calm(points, false, options);
    EXPECT_TRUE(run.band.within);
    EXPECT_EQ(run.waves.turns > 0, errors >= 4) << height;
  }
}

// Curvature that changes at both ends, which the curve of least variation does not follow there:
// the points of a free end pull twice as much each time, up to sixty-four times; of a held one not
// at all.
TEST(CalmLimits, PointsOfFreeEndsPullUntilTheyLeanNoMore) {
  for (const bool held : {false, true}) {
    std::vector<FitPoint> points;
    for (int i = 0; i <= 60; ++i) {
      const double x = i / 60.0;
      points.push_back({.position = {x, 0.05 * (std::pow(x, 6) + std::pow(1 - x, 6))}});
    }
    CalmRunOptions options;
    options.tolerance = 5e-3;
    options.residuals = {.rms = 3e-4, .noise = 1e-6, .standard_error = 0.1};
    if (held) options.start = {Hold::position, {points.front().position, 0, 0}};
    EXPECT_TRUE(solve_calm(points, false, options).band.within);
    EXPECT_EQ(points.front().pull, held ? 1 : 64);
    EXPECT_EQ(points.back().pull, 64);
    EXPECT_EQ(points[30].pull, 1);
  }
}

// Measured in five pieces, one more than that may be needed; where pieces are too far off by a
// little, stiffer springs bring them near.
TEST(CalmLimits, TakesNotManyMorePiecesThanWereMeasured) {
  for (const int seed : {6, 15, 32}) {
    ASSERT_EQ(testing::random_chain(static_cast<std::uint64_t>(seed)).pieces.size(), 5U);
    std::vector<FitPoint> points = measured(seed, 5e-4);
    const CalmRun run = solved(points, 5e-4, noise_factor(80) * 5e-4);
    EXPECT_TRUE(run.band.within) << seed;
    EXPECT_LE(run.curve.alpha.size(), 6U) << seed;
  }
}

// A straight stretch, a clothoid and an arc, measured: the line is found as one, the arc where arcs
// are asked for.
TEST(CalmLimits, LinesAndArcsAreFoundAsWhatTheyAre) {
  const lac::Chain truth{
      {{0, 0}, 0.2}, {{-1, 0.4, 0, 0}, {-1, 0.25, 0, 5}, {-1, 0.35, 5, 5}}, false};
  for (const bool arcs : {false, true}) {
    auto points = fit_points(testing::measure(truth, 120, 2e-4, 1));
    CalmRunOptions options;
    options.tolerance = noise_factor(120) * 2e-4;
    options.residuals =
        allowed_residuals(points, false, points.size(), 2e-4, options.tolerance, 0.5);
    options.arcs = arcs;
    const CalmRun run = solve_calm(points, false, options);
    EXPECT_TRUE(run.band.within);
    const auto& kind = run.curve.kind;
    ASSERT_GE(kind.size(), 2U);
    EXPECT_EQ(kind.front(), PieceKind::line);
    EXPECT_NEAR(run.curve.at[static_cast<std::size_t>(run.curve.cut[1])], 0.4, 0.08);
    EXPECT_EQ(std::ranges::count(kind, PieceKind::line), 1);
    EXPECT_EQ(kind.back() == PieceKind::arc, arcs);
  }
}

// Means that spread wider than the tolerance are not within it, whatever the curve; the one given
// is of pieces all the same.
TEST(CalmLimits, WhatCannotBeWithinIsToldAndOfPieces) {
  auto points = fit_points(lac::sample(lac::Chain{{{0, 0}, 0.3}, {{-1, 1, 0.5, 4.5}}, false}, 40));
  points[20].high = 2e-3;
  // Of the curves tried it is that in nine tenths of the tolerance, which is the calmest.
  DenseCurve calmest = dense_curve(points, false, 240);
  const double energy =
      least_variation(calmest, points, {.tolerance = 0.9e-3, .progress = {}}).energy;
  CalmRunOptions options;
  options.tolerance = 1e-3;
  const CalmRun run = solve_calm(points, false, options);
  EXPECT_FALSE(run.band.within);
  EXPECT_NEAR(run.calm_energy, energy, 1e-6 * energy);
  ASSERT_FALSE(run.curve.alpha.empty());
  EXPECT_LT(run.curve.alpha.size(), 40U);
}

}  // namespace
}  // namespace keyline::fairing::detail
