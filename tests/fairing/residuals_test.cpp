#include "keyline/fairing/residuals.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/fairing/fair.h"

/// What offsets may be, by the formulas of fairness.md and the normal distribution.
namespace keyline::fairing::detail {
namespace {

std::vector<FitPoint> spread(int n) {
  std::vector<FitPoint> points;
  for (int i = 0; i < n; ++i) points.push_back({.position = {double(i) / n, 0}});
  return points;
}

// One normal error in twenty runs of 200 passes 3.6623 standard deviations, of a few never 3.
TEST(NoiseFactor, IsTheNormalDistributions) {
  EXPECT_NEAR(noise_factor(200), 3.662260, 1e-5);
  EXPECT_NEAR(noise_factor(20), 3.023341, 1e-5);
  EXPECT_EQ(noise_factor(10), 3);
  EXPECT_EQ(noise_factor(0), 3);
  EXPECT_NEAR(default_tolerance(1e-3, 1, 200), 3.662260e-3, 1e-8);
  EXPECT_EQ(default_tolerance(1e-6, 2, 200), 2e-4);
}

// Of a tolerance of 8 noises 8 - 3.6623 are left beside the errors; at smoothness 0.5 all of that
// and one standard error of the mean square of 200, at 0.25 half of both.
TEST(Residuals, TakeTheirShareOfWhatTheToleranceLeaves) {
  const double noise = 1e-3, left = 8e-3 - 3.662260e-3, error = 1 / std::sqrt(400.0);
  const auto at = [&](double smoothness) {
    return allowed_residuals(spread(200), false, 200, noise, 8e-3, smoothness);
  };
  for (const double smoothness : {0.0, 0.25, 0.5}) {
    const double calm = 2 * smoothness;
    const Residuals r = at(smoothness);
    EXPECT_NEAR(r.rms, std::hypot(noise * (1 + calm * error), calm * left), 1e-8);
    EXPECT_NEAR(r.left, left, 1e-8);
    EXPECT_EQ(r.noise, noise);
    EXPECT_EQ(r.scatter, 0);
    EXPECT_NEAR(r.standard_error, error, 1e-15);
  }
  // On from there to what offsets spread evenly over the tolerance have.
  const double most = 8e-3 / std::sqrt(3.0), half = at(0.5).rms;
  EXPECT_NEAR(at(0.75).rms, std::sqrt(half * most), 1e-8);
  EXPECT_EQ(at(1).rms, 0);  // as the tolerance has it
  EXPECT_EQ(at(1).standard_error, 0);
}

TEST(Residuals, AreAHundredthOfTheToleranceAtLeast) {
  EXPECT_NEAR(allowed_residuals(spread(200), false, 200, 1e-9, 1e-2, 0).rms, 1e-4, 1e-12);
  // Less than the errors take leaves nothing.
  const Residuals tight = allowed_residuals(spread(200), false, 200, 1e-3, 2e-3, 0.5);
  EXPECT_EQ(tight.left, 0);
  EXPECT_NEAR(tight.rms, 1.05e-3, 1e-9);
}

// So many standard errors above what is expected; none where the tolerance alone counts.
TEST(Residuals, MayBeSomeErrorsMore) {
  const Residuals r{.rms = 2, .noise = 1, .scatter = 0, .left = 0, .standard_error = 0.1};
  EXPECT_NEAR(r.most(0), 2, 1e-15);
  EXPECT_NEAR(r.most(3), 2.6, 1e-15);
  const Residuals means{.rms = 3, .noise = 1, .scatter = 4, .left = 0, .standard_error = 0.1};
  EXPECT_NEAR(means.most(2), std::sqrt(36 - 16), 1e-14);  // 5 grown by a fifth, less the scatter
  EXPECT_EQ(Residuals{}.most(3), HUGE_VAL);
}

}  // namespace
}  // namespace keyline::fairing::detail
