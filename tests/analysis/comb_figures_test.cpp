#include "keyline/analysis/comb_figures.h"

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

TEST(CombFigures, OfASine) {
  const CombFigures f =
      comb_figures(graph(7, [](double t) { return std::sin(6 * std::numbers::pi * t); }));
  EXPECT_EQ(f.waves, 6);
  // integral of (6 pi cos)^2
  EXPECT_NEAR(f.energy, 18 * std::numbers::pi * std::numbers::pi, 1e-3);
  EXPECT_NEAR(f.jolt, std::sin(6 * std::numbers::pi * 0.0025), 1e-3);
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

}  // namespace
}  // namespace keyline::analysis
