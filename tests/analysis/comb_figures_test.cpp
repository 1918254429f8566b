#include "keyline/analysis/comb_figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace keyline::analysis {
namespace {

curve::CurvatureGraph graph(double length, double (*curvature)(double), int samples = 20000) {
  curve::CurvatureGraph g;
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    g.arc_length.push_back(length * t);
    g.curvature.push_back(curvature(t) / length);
  }
  return g;
}

TEST(CombFigures, OfAClothoid) {
  for (const double length : {1.0, 2500.0}) {
    const CombFigures f = comb_figures(graph(length, [](double t) { return 3 * t; }));
    EXPECT_EQ(f.waves, 0);
    EXPECT_NEAR(f.energy, 9, 1e-9);           // (change of curvature times length)^2
    EXPECT_NEAR(f.jolt, 0.005 / 0.99, 1e-6);  // of the range without its tails
  }
}

TEST(CombFigures, OfASineAreThoseOfItsFormula) {
  const CombFigures f =
      comb_figures(graph(7, [](double t) { return std::sin(6 * std::numbers::pi * t); }));
  EXPECT_EQ(f.waves, 6);
  // integral of (6 pi cos)^2
  EXPECT_NEAR(f.energy, 18 * std::numbers::pi * std::numbers::pi, 1e-3);
  EXPECT_NEAR(f.jolt, std::sin(6 * std::numbers::pi * 0.0025), 1e-3);
}

// A plateau, and from 0 to its height within the last 0.5 % of the length.
TEST(CombFigures, JoltIsThatOfTheVeryEndToo) {
  const auto k = [](double t) {
    const double plateau = std::clamp(std::min(t - 0.2, 0.8 - t) / 0.1, 0.0, 1.0);
    return plateau + std::max(0.0, (t - 0.995) / 0.005);
  };
  EXPECT_NEAR(comb_figures(graph(3, k)).jolt, 1, 1e-6);
}

// Curvature of an arc given as a rational Bezier: rounding, which turns at every second sample.
TEST(CombFigures, OfRoundingAreNone) {
  for (const double turning : {0.0, 1.5, 900.0}) {
    curve::CurvatureGraph g = graph(20, [](double) { return 0.0; });
    for (std::size_t i = 0; i < g.curvature.size(); ++i)
      g.curvature[i] = (turning + (i % 2 == 0 ? 1e-13 : -1e-13) * std::max(1.0, turning)) / 20;
    const CombFigures f = comb_figures(g);
    EXPECT_EQ(f.waves, 0);
    EXPECT_EQ(f.energy, 0);
    EXPECT_EQ(f.jolt, 0);
    EXPECT_TRUE(comb_marks(g).empty());
  }
  // A needle takes nothing from the waves beside it.
  curve::CurvatureGraph g = graph(1, [](double t) { return 1e-4 * std::sin(20 * t); });
  g.curvature[1000] = 1e9;
  EXPECT_GE(comb_figures(g).waves, 6);
}

TEST(CombFigures, CountNoWaveThatIsNotSeen) {
  const auto rippled = [](double t) { return 3 * t + 0.02 * std::sin(200 * t); };
  EXPECT_EQ(comb_figures(graph(1, rippled)).waves, 0);
  const auto waved = [](double t) { return 3 * t + 0.2 * std::sin(100 * t); };
  EXPECT_GT(comb_figures(graph(1, waved)).waves, 20);
}

TEST(CombFigures, OfACircleAreNone) {
  const CombFigures f = comb_figures(graph(5, [](double) { return 6.28; }));
  EXPECT_EQ(f.waves, 0);
  EXPECT_EQ(f.energy, 0);
  EXPECT_EQ(f.jolt, 0);
}

TEST(CombMarks, FindANearStepAndANeedle) {
  // 1 over a hundredth of the length about the middle: half of it within 0.5 %.
  const auto step = [](double t) { return std::clamp((t - 0.495) / 0.01, 0.0, 1.0); };
  const auto steps = comb_marks(graph(10, step));
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_FALSE(steps[0].needle);
  EXPECT_NEAR(steps[0].at, 5, 0.05);
  EXPECT_NEAR(steps[0].change, 0.5, 1e-9);
  // The same up and down again.
  const auto needle = [](double t) {
    return std::max(0.0, 1 - std::abs(t - 0.3) / 0.01) + 0.01 * t;
  };
  const auto needles = comb_marks(graph(10, needle));
  ASSERT_EQ(needles.size(), 1U);
  EXPECT_TRUE(needles[0].needle);
  EXPECT_NEAR(needles[0].at, 3, 1e-9);
}

TEST(CombMarks, PassWhatIsSmooth) {
  EXPECT_TRUE(comb_marks(graph(1, [](double t) { return std::sin(40 * t); })).empty());
  // Three times the width of a near-step.
  const auto ramp = [](double t) { return std::clamp((t - 0.4) / 0.03, 0.0, 1.0); };
  EXPECT_TRUE(comb_marks(graph(1, ramp)).empty());
  EXPECT_TRUE(comb_marks(graph(5, [](double) { return 2.0; })).empty());
}

}  // namespace
}  // namespace keyline::analysis
