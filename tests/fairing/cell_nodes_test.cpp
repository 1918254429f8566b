#include "keyline/fairing/cell_nodes.h"

#include <cmath>

#include <gtest/gtest.h>

/// Sums over a cell.
namespace keyline::fairing::detail {
namespace {

// Gauss' rule of n points is exact for polynomials of degree 2 n - 1.
TEST(CellNodes, RuleOfFourPointsTakesDegreeSeven) {
  for (int degree = 0; degree <= 7; ++degree) {
    double sum = 0;
    for (std::size_t q = 0; q < 4; ++q) sum += kWeight[q] * std::pow(kNode[q], degree);
    EXPECT_NEAR(sum, 1.0 / (degree + 1), 1e-15) << degree;
  }
  double sum = 0;
  for (std::size_t q = 0; q < 4; ++q) sum += kWeight[q] * std::pow(kNode[q], 8);
  EXPECT_GT(std::abs(sum - 1.0 / 9), 1e-6);
}

// Lagrange's parabolas through 0, 1/2 and 1, written out: (1 - u)(1 - 2u), 4 u (1 - u), u (2u - 1).
TEST(CellNodes, ParabolasAreTheIntegralsOfLagranges) {
  const auto integral = [](auto f, double u) {  // Simpson's rule is exact for parabolas
    return u / 6 * (f(0.0) + 4 * f(u / 2) + f(u));
  };
  for (const double u : {0.0, 0.1, 0.37, 0.5, 0.8, 1.0}) {
    const auto p = parabolas(u);
    EXPECT_NEAR(p[0], integral([](double x) { return (1 - x) * (1 - 2 * x); }, u), 1e-15);
    EXPECT_NEAR(p[1], integral([](double x) { return 4 * x * (1 - x); }, u), 1e-15);
    EXPECT_NEAR(p[2], integral([](double x) { return x * (2 * x - 1); }, u), 1e-15);
  }
}

TEST(CellNodes, TurnedIsARotationForAnyAngle) {
  for (const double angle : {-3.0, -0.4, -0.29, 0.0, 0.1, 0.299, 0.31, 1.0, 2.5}) {
    const core::Vector2 t = turned({0.6, 0.8}, angle);
    EXPECT_NEAR(t.x, 0.6 * std::cos(angle) - 0.8 * std::sin(angle), 1e-13) << angle;
    EXPECT_NEAR(t.y, 0.6 * std::sin(angle) + 0.8 * std::cos(angle), 1e-13) << angle;
  }
}

TEST(CellNodes, HoldWhatTheCellTurnsUpToThere) {
  CellShape shape;
  shape.curvature = {1, 2, 4};
  for (const double h : {0.05, 0.4})
    for (const double v : {0.5, 1.0}) {
      const Nodes nodes(shape, h, v);
      for (std::size_t q = 0; q < 4; ++q) {
        const double u = v * kNode[q];
        // The parabola through 1, 2 and 4: 1 + u + 2 u^2.
        const double turn = h * (u + u * u / 2 + 2 * u * u * u / 3);
        EXPECT_NEAR(nodes.cosine[q], std::cos(turn), 1e-13);
        EXPECT_NEAR(nodes.sine[q], std::sin(turn), 1e-13);
        EXPECT_NEAR(h * nodes.sum(q, shape.curvature), turn, 1e-14);
        const core::Vector2 t = nodes.tangent({0, 1}, q);
        EXPECT_NEAR(t.x, -kWeight[q] * std::sin(turn), 1e-13);
        EXPECT_NEAR(t.y, kWeight[q] * std::cos(turn), 1e-13);
      }
    }
}

TEST(CellNodes, SumsAreOfThreeProducts) { EXPECT_EQ(sum_of({1, 2, 3}, {4, 5, 6}), 32); }

}  // namespace
}  // namespace keyline::fairing::detail
