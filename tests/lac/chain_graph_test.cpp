#include "keyline/lac/chain/chain_graph.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::lac {
namespace {

const Chain kChain{{{0, 0}, 0}, {{-1, 2, 1, 2}, {0.5, 1, 3, 1}}, false};

// Joints stand there twice, once with either side's curvature; places are Chebyshev's.
TEST(ChainGraph, IsCurvatureAlongTheChain) {
  const auto graph = curvature_graph(kChain, 4);
  ASSERT_EQ(graph.arc_length.size(), 10U);
  const double root = std::sqrt(0.5);
  const std::vector<double> share{0, 0.5 * (1 - root), 0.5, 0.5 * (1 + root), 1};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(graph.arc_length[i], 2 * share[i], 1e-15);
    EXPECT_NEAR(graph.curvature[i], 1 + share[i], 1e-15);
    EXPECT_NEAR(graph.arc_length[5 + i], 2 + share[i], 1e-15);
    // Curvature to the power -1/2 is linear.
    const double power = (1 - share[i]) / std::sqrt(3) + share[i];
    EXPECT_NEAR(graph.curvature[5 + i], 1 / (power * power), 1e-14);
  }
}

TEST(ChainGraph, FastestRateIsAtAnEndOfAPiece) {
  // d/ds of (a + b s)^-2 with b = 1 - 1 / sqrt 3: -2 b times curvature to 3/2, most at 3.
  const double b = 1 - 1 / std::sqrt(3);
  EXPECT_NEAR(fastest_rate(kChain), 2 * b * std::pow(3, 1.5), 1e-12);
  EXPECT_NEAR(fastest_rate({{}, {{-1, 2, 1, 2}}, false}), 0.5, 1e-15);
  EXPECT_NEAR(fastest_rate({{}, {{-1, 2, -1, 2}}, false}), 1.5, 1e-15);
  // Below -1 the rate has no bound at an inflection.
  EXPECT_EQ(fastest_rate({{}, {{-1.5, 2, -1, 2}}, false}), HUGE_VAL);
  EXPECT_EQ(fastest_rate({{}, {{-1.5, 2, 0, 2}}, false}), HUGE_VAL);
  EXPECT_TRUE(std::isfinite(fastest_rate({{}, {{-1.5, 2, 1, 2}}, false})));
  EXPECT_EQ(fastest_rate({{}, {{-1.5, 2, 0, 0}}, false}), 0);
}

}  // namespace
}  // namespace keyline::lac
