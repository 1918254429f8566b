#include "keyline/numeric/solve.h"

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd matrix(Eigen::Index rows, std::initializer_list<double> values) {
  MatrixXd m(rows, static_cast<Eigen::Index>(values.size()) / rows);
  Eigen::Index k = 0;
  for (const double value : values) {
    m(k / m.cols(), k % m.cols()) = value;
    ++k;
  }
  return m;
}

VectorXd column(std::initializer_list<double> values) {
  return matrix(static_cast<Eigen::Index>(values.size()), values).col(0);
}

// The line of least squares through (0, 1), (1, 0), (2, 5): y = 2 x + 0.
TEST(Solve, LineThroughThreePoints) {
  const MatrixXd a = matrix(3, {1, 0, 1, 1, 1, 2});
  const VectorXd b = column({1, 0, 5});
  const VectorXd line = column({0, 2});
  EXPECT_LT((least_squares(a, b) - line).norm(), 1e-14);
  EXPECT_LT((pivoted_least_squares(a, b) - line).norm(), 1e-14);
  EXPECT_LT((least_norm(a, b) - line).norm(), 1e-14);
  EXPECT_LT((solve_symmetric(a.transpose() * a, a.transpose() * b) - line).norm(), 1e-13);
}

// x + 2 y = 5 twice: (1, 2) is the nearest to 0 of all that solve it.
TEST(Solve, ShortestOfMany) {
  const MatrixXd a = matrix(2, {1, 2, 1, 2});
  EXPECT_LT((least_norm(a, column({5, 5})) - column({1, 2})).norm(), 1e-14);
  // Two rows of which the second says little: within 0.1 it counts as the first again.
  const MatrixXd nearly = matrix(2, {1, 2, 1, 2.001});
  EXPECT_LT((least_norm(nearly, column({5, 5}), 0.1) - column({1, 2})).norm(), 1e-2);
  EXPECT_LT((least_norm(nearly, column({5, 5})) - column({5, 0})).norm(), 1e-9);
}

TEST(Solve, ColumnThatRepeatsAnotherIsLeftOut) {
  const MatrixXd a = matrix(3, {1, 1, 2, 2, 2, 2});
  const MatrixXd x = pivoted_least_squares(a, matrix(3, {3, 6, 6, 12, 6, 12}));
  EXPECT_NEAR(x.col(0).sum(), 3, 1e-14);
  EXPECT_NEAR(x.col(1).sum(), 6, 1e-14);
  EXPECT_EQ(x.col(0).cwiseAbs().minCoeff(), 0);
}

TEST(Solve, InverseOrNone) {
  const auto found = inverse(matrix(2, {2, 1, 1, 1}));
  ASSERT_TRUE(found);
  EXPECT_LT((*found - matrix(2, {1, -1, -1, 2})).norm(), 1e-14);
  EXPECT_FALSE(inverse(matrix(2, {1, 2, 2, 4})));
}

// The string that hangs under its weight: second differences of x are 1, x = -i (5 - i) / 2.
TEST(Solve, SparseSymmetric) {
  const auto chain = [](double middle) {
    Eigen::SparseMatrix<double> m(4, 4);
    for (int i = 0; i < 4; ++i) m.insert(i, i) = middle;
    for (int i = 0; i < 3; ++i) m.insert(i + 1, i) = 1;
    return m;
  };
  SparseSymmetric factor(chain(-2));
  ASSERT_TRUE(factor);
  const VectorXd hanging = column({-2, -3, -3, -2});
  EXPECT_LT((factor.solve(VectorXd(VectorXd::Ones(4))) - hanging).norm(), 1e-14);
  const MatrixXd both = factor.solve(MatrixXd(MatrixXd::Ones(4, 2)));
  EXPECT_LT((both.col(1) - hanging).norm(), 1e-14);
  factor.renew(chain(2));  // 2 x_i and its neighbours make 1
  ASSERT_TRUE(factor);
  EXPECT_LT((factor.solve(VectorXd(VectorXd::Ones(4))) - column({0.4, 0.2, 0.2, 0.4})).norm(),
            1e-14);
  Eigen::SparseMatrix<double> none(2, 2);
  none.insert(1, 0) = 1;
  EXPECT_FALSE(SparseSymmetric(none));
}

// Every matrix is solved with, whether or not it has its numbers where the one before had them.
TEST(Solve, SparseSymmetricOfOtherPlaces) {
  const auto arrow = [](int tip) {  // ones on the diagonal and, of one row and column, a half
    Eigen::SparseMatrix<double> m(3, 3);
    for (int i = 0; i < 3; ++i) m.insert(i, i) = 1;
    for (int i = 0; i < 3; ++i)
      if (i != tip) m.insert(std::max(i, tip), std::min(i, tip)) = 0.5;
    return m;
  };
  SparseSymmetric factor;
  EXPECT_FALSE(factor);
  for (const int tip : {0, 2, 1, 1, 0}) {
    factor.renew(arrow(tip));
    ASSERT_TRUE(factor);
    VectorXd right = column({1.5, 1.5, 1.5});  // of ones at the tip's sides, and the tip's: 2
    right[tip] = 2;
    EXPECT_LT((factor.solve(right) - VectorXd::Ones(3)).norm(), 1e-14) << tip;
  }
}

}  // namespace
}  // namespace keyline::numeric
