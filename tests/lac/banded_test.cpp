#include "keyline/lac/g2/banded.h"

#include <algorithm>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace keyline::lac::detail {
namespace {

// Beside a dense solver; in every other matrix rows have to be exchanged.
TEST(PentadiagonalSystem, SolvesAsADenseSolverDoes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int time = 0; time < 60; ++time) {
    const int n = 1 + time % 12;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd sides(n, 2);
    PentadiagonalSystem system;
    system.reset(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      for (int k = std::max(0, i - 2); k <= std::min(n - 1, i + 2); ++k) {
        matrix(i, k) = any(random) + (i == k && time % 2 == 0 ? 5 : 0);
        system.at(i, k) = matrix(i, k);
      }
      for (int side = 0; side < 2; ++side) system.sides(i)[side] = sides(i, side) = any(random);
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> dense(matrix);
    if (!(dense.rcond() > 1e-4)) continue;
    ASSERT_TRUE(system.solve());
    const Eigen::MatrixXd expected = dense.solve(sides);
    for (int i = 0; i < n; ++i)
      for (int side = 0; side < 2; ++side)
        EXPECT_NEAR(system.sides(i)[side], expected(i, side), 1e-10) << n << ' ' << i;
  }
}

TEST(PentadiagonalSystem, TellsSingularMatrices) {
  PentadiagonalSystem system;
  system.reset(3);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) system.at(i, k) = i + 1;
  EXPECT_FALSE(system.solve());
}

}  // namespace
}  // namespace keyline::lac::detail
