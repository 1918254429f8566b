#include "keyline/numeric/block_cholesky.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

using Eigen::MatrixXd;
using Eigen::SparseMatrix;
using Eigen::VectorXd;

/// J'J of sines, whose rows reach over groups of `wide` unknowns, one group apart, and homing.
SparseMatrix<double> chain_of_groups(int groups, int wide, double phase) {
  SparseMatrix<double> j(2 * groups * wide, groups * wide);
  for (int row = 0; row < (groups - 1) * wide; ++row)
    for (int k = 0; k < 2 * wide; ++k)
      j.insert(row, row / wide * wide + k) = std::sin(3.7 * row + 1.3 * k * k + phase);
  for (int i = 0; i < groups * wide; ++i) j.insert(groups * wide + i, i) = 1e-3;
  return j.transpose() * j;
}

double error(const BlockCholesky& factor, const SparseMatrix<double>& a) {
  VectorXd wanted(a.cols());
  for (Eigen::Index i = 0; i < wanted.size(); ++i) wanted[i] = std::cos(2.0 * i);
  return (factor.solve(MatrixXd(a) * wanted) - wanted).lpNorm<Eigen::Infinity>();
}

// Matrices made so that the solution is known: with numbers at the same places, at others, with
// groups that are one unknown each, and of parts that know nothing of one another.
TEST(BlockCholesky, FindsTheSolutionThatTheRightSideWasMadeOf) {
  BlockCholesky factor;
  for (const auto& [groups, wide, phase] : {std::tuple{9, 4, 0.0}, std::tuple{9, 4, 0.5},
                                            std::tuple{4, 9, 0.2}, std::tuple{30, 1, 0.1}}) {
    const SparseMatrix<double> a = chain_of_groups(groups, wide, phase);
    ASSERT_TRUE(factor.renew(a)) << groups;
    EXPECT_LT(error(factor, a), 1e-7) << groups;  // 1e6 is the matrix' condition
  }
  SparseMatrix<double> parts(5, 5);
  for (int i = 0; i < 5; ++i) parts.insert(i, i) = 2;
  parts.insert(3, 0) = 1;
  const SparseMatrix<double> whole = parts.selfadjointView<Eigen::Lower>();
  ASSERT_TRUE(factor.renew(parts));  // the lower half is read
  EXPECT_LT(error(factor, whole), 1e-14);
}

TEST(BlockCholesky, TellsWhereAMatrixIsNotDefinite) {
  SparseMatrix<double> a(2, 2);
  a.insert(0, 0) = a.insert(1, 1) = 1;
  a.insert(1, 0) = 2;
  BlockCholesky factor;
  EXPECT_FALSE(factor.renew(a));
  a.coeffRef(1, 0) = 0.5;
  ASSERT_TRUE(factor.renew(a));
  EXPECT_LT((factor.solve(VectorXd{{1.5, 1.5}}) - VectorXd::Ones(2)).norm(), 1e-15);
}

}  // namespace
}  // namespace keyline::numeric
