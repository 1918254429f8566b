#include "keyline/analysis/waves.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

/// Waves of curvature that are merged, by what they move the curve sideways: curvature
/// a sin(2 pi s / w) is the second derivative of a line that is a (w / 2 pi)^2 off.
namespace keyline::analysis::detail {
namespace {

/// Samples in the middle of steps of 1e-4, so that none lies at a zero.
std::vector<Sample> sampled(double length, const std::function<double(double)>& curvature) {
  std::vector<Sample> samples;
  const int n = static_cast<int>(std::lround(length / 1e-4));
  for (int i = 0; i < n; ++i) {
    const double s = (i + 0.5) * 1e-4;
    samples.push_back({s / length, s, curvature(s), 0});
  }
  return samples;
}

double sine(double height, double wavelength, double s) {
  return height * std::sin(2 * core::kPi * s / wavelength);
}

const double kOff = 0.01 * std::pow(0.4 / (2 * core::kPi), 2);

// One wave of height 0.01 and length 0.4 between two rises.
TEST(SignificantTurns, AWholeWaveIsOffByItsHeightAndLength) {
  const auto samples = sampled(3, [](double s) {
    return s < 1 ? s : s < 1.4 ? 1 + sine(0.01, 0.4, s - 1) : s - 0.4;
  });
  std::vector<MergedWave> merged;
  const std::size_t last = samples.size() - 1;
  EXPECT_EQ(significant_turns(samples, 0, last, 0.99 * kOff, {}, merged).size(), 4U);
  EXPECT_TRUE(merged.empty());
  EXPECT_EQ(significant_turns(samples, 0, last, 1.01 * kOff, {}, merged).size(), 2U);
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_NEAR(merged[0].swing, 0.02, 1e-6);
  EXPECT_NEAR(merged[0].wavelength, 0.4, 1e-3);
  EXPECT_NEAR(merged[0].displacement, kOff, 0.01 * kOff);
  EXPECT_NEAR(merged[0].t.low, 1.0 / 3, 1e-3);
  EXPECT_NEAR(merged[0].t.high, 1.4 / 3, 1e-3);
}

// Of one that begins or ends at its height three quarters are there.
TEST(SignificantTurns, AtAnEndThreeQuartersOfAWaveShow) {
  for (const bool end : {false, true}) {
    const auto samples = sampled(2, [&](double s) {
      const double from = end ? 2 - s : s;
      return from < 0.3 ? sine(0.01, 0.4, from + 0.1) : from - 0.3;
    });
    std::vector<MergedWave> merged;
    const std::size_t last = samples.size() - 1;
    EXPECT_EQ(significant_turns(samples, 0, last, 0.99 * kOff, {}, merged).size(), 3U);
    EXPECT_EQ(significant_turns(samples, 0, last, 1.01 * kOff, {}, merged).size(), 2U);
    ASSERT_EQ(merged.size(), 1U);
    EXPECT_NEAR(merged[0].wavelength, 0.4, 1e-3);
    EXPECT_NEAR(merged[0].displacement, kOff, 0.01 * kOff);
  }
}

// A lobe of the other sign, half such a wave, between two that are larger.
TEST(SignificantCrossings, ALobeIsHalfAWave) {
  const auto samples = sampled(2.2, [](double s) {
    return s < 1 ? sine(1, 2, s) : s < 1.2 ? -sine(0.01, 0.4, s - 1) : sine(1, 2, s - 1.2);
  });
  const std::vector<std::size_t> crossings{9999, 11999};
  std::vector<MergedWave> merged;
  const auto left = [&](double noise, double rounding) {
    return significant_crossings(samples, 0, samples.size() - 1, crossings, noise,
                                 Rounding{.least = rounding}, merged);
  };
  EXPECT_EQ(left(0.99 * kOff, 0), crossings);
  EXPECT_TRUE(merged.empty());
  EXPECT_TRUE(left(1.01 * kOff, 0).empty());
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_NEAR(merged[0].swing, 0.01, 1e-6);
  EXPECT_NEAR(merged[0].wavelength, 0.4, 1e-3);
  EXPECT_NEAR(merged[0].displacement, kOff, 0.01 * kOff);
  // What swings by no more than rounding goes without a word.
  EXPECT_TRUE(left(0, 0.011).empty());
  EXPECT_EQ(merged.size(), 1U);
}

// At either end one crossing goes with its lobe.
TEST(SignificantCrossings, ALobeAtAnEndTakesOneCrossing) {
  const auto samples = sampled(1.4, [](double s) {
    return s < 0.2 ? sine(0.01, 0.4, s) : s < 1.2 ? -sine(1, 2, s - 0.2) : sine(0.02, 0.4, s - 1.2);
  });
  std::vector<MergedWave> merged;
  const auto left = [&](double noise) {
    return significant_crossings(samples, 0, samples.size() - 1, {1999, 11999}, noise, {}, merged);
  };
  EXPECT_EQ(left(1.5 * kOff), (std::vector<std::size_t>{11999}));
  EXPECT_TRUE(left(2.1 * kOff).empty());
}

}  // namespace
}  // namespace keyline::analysis::detail
