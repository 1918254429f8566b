#include "keyline/fairing/dense_riccati.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "keyline/numeric/random.h"

/// The sweep over cells against one dense system of all its equations.
namespace keyline::fairing::detail {
namespace {

Cell random_cell(numeric::Random& random) {
  Cell cell;
  Matrix6 root;
  for (double& x : root.reshaped()) x = random.normal();
  cell.hessian = root * root.transpose() + 0.1 * Matrix6::Identity();
  for (double& x : cell.gradient) x = random.normal();
  for (double& x : cell.step.reshaped()) x = random.normal();
  for (double& x : cell.gap) x = random.normal();
  return cell;
}

/// Unknown are all states and, behind every cell that a piece ends with, the end curvature of the
/// next one: rows say what the state behind a cell is.
Eigen::VectorXd dense_solution(const std::vector<Cell>& cells, const DenseBoundary& boundary) {
  const int n = static_cast<int>(cells.size());
  const int unknowns = 6 * (n + 1);
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> right;
  const auto equation = [&](double value) -> Eigen::VectorXd& {
    rows.emplace_back(Eigen::VectorXd::Zero(unknowns));
    right.push_back(value);
    return rows.back();
  };
  for (int i = 0; i < n; ++i) {
    const Cell& cell = cells[i];
    for (int r = 0; r < 3; ++r) {
      auto& row = equation(-cell.gap(r));
      for (int c = 0; c < 6; ++c) row(6 * i + c) = cell.step(r, c);
      row(6 * (i + 1) + r) = -1;
    }
    const bool passes = cell.passage.ends_piece && !cell.passage.arc;
    auto& start = equation(0);
    start(6 * i + (passes ? 4 : 3)) = 1;
    start(6 * (i + 1) + 3) = -1;
    if (!cell.passage.ends_piece || cell.passage.ends_curve) {
      auto& end = equation(0);
      end(6 * i + 4) = 1;
      end(6 * (i + 1) + 4) = -1;
    } else if (cell.passage.fixed) {
      equation(0)(6 * (i + 1) + 4) = 1;
    }
    auto& length = equation(0);
    length(6 * i + 5) = 1;
    length(6 * (i + 1) + 5) = -1;
  }
  for (int k = 0; k < 6; ++k)
    if (boundary.fixed_start[k]) equation(0)(k) = 1;
  const auto m = static_cast<int>(rows.size());
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(unknowns + m, unknowns + m);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(unknowns + m);
  for (int i = 0; i < n; ++i) {
    k.block<6, 6>(6 * i, 6 * i) += cells[i].hessian;
    rhs.segment<6>(6 * i) -= cells[i].gradient;
  }
  const Matrix6& h = boundary.end_hessian;
  k.block<6, 6>(6 * n, 6 * n) += h;
  rhs.segment<6>(6 * n) -= boundary.end_gradient;
  if (boundary.closed) {
    k.block<6, 6>(0, 0) += h;
    k.block<6, 6>(0, 6 * n) -= h;
    k.block<6, 6>(6 * n, 0) -= h;
    rhs.segment<6>(0) += boundary.end_gradient;
  }
  for (int r = 0; r < m; ++r) {
    k.row(unknowns + r).head(unknowns) = rows[r].transpose();
    k.col(unknowns + r).head(unknowns) = rows[r];
    rhs(unknowns + r) = right[r];
  }
  return k.fullPivLu().solve(rhs);
}

std::vector<Cell> some_cells(unsigned seed) {
  numeric::Random random(seed);
  std::vector<Cell> cells;
  for (int i = 0; i < 7; ++i) cells.push_back(random_cell(random));
  cells[1].passage = {.ends_piece = true};
  cells[3].passage = {.ends_piece = true, .arc = true};
  cells[4].passage = {.ends_piece = true, .fixed = true};
  cells[6].passage = {.ends_piece = true, .ends_curve = true};
  return cells;
}

void expect_dense(const std::vector<Cell>& cells, const DenseBoundary& boundary) {
  const DenseStep step = solve_cells(cells, boundary);
  ASSERT_TRUE(step.sound);
  ASSERT_EQ(step.state.size(), cells.size() + 1);
  const Eigen::VectorXd dense = dense_solution(cells, boundary);
  double most = 0;
  for (std::size_t i = 0; i <= cells.size(); ++i)
    for (int k = 0; k < 6; ++k) most = std::max(most, std::abs(dense(6 * int(i) + k)));
  for (std::size_t i = 0; i <= cells.size(); ++i)
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(step.state[i](k), dense(6 * int(i) + k), 1e-7 * most) << i << ' ' << k;
  // The multipliers of x, y and direction behind each cell are what a gap is worth.
  double costate = 0;
  const int unknowns = 6 * int(cells.size() + 1);
  int row = unknowns;
  for (const Cell& cell : cells) {
    for (int r = 0; r < 3; ++r) costate = std::max(costate, std::abs(dense(row + r)));
    row += 5;
    const Passage& p = cell.passage;
    if (!p.ends_piece || p.ends_curve || p.fixed) ++row;
  }
  EXPECT_NEAR(step.largest_costate, costate, 1e-6 * costate);
}

TEST(DenseRiccati, AgreesWithTheDenseSystem) {
  DenseBoundary boundary;
  boundary.end_hessian.diagonal() << 3, 3, 3, 3, 0, 0;
  boundary.end_gradient << 1, -2, 0.5, 4, 0, 0;
  for (const unsigned seed : {5U, 6U, 7U}) expect_dense(some_cells(seed), boundary);
}

TEST(DenseRiccati, HeldStartsStay) {
  DenseBoundary boundary;
  for (const int k : {0, 1, 4}) boundary.fixed_start[k] = true;
  expect_dense(some_cells(8), boundary);
  const DenseStep step = solve_cells(some_cells(8), boundary);
  for (const int k : {0, 1, 4}) EXPECT_EQ(step.state[0](k), 0);
  EXPECT_NE(step.state[0](2), 0);
}

TEST(DenseRiccati, ClosedCurvesAreTiedToTheirStart) {
  DenseBoundary boundary;
  boundary.closed = true;
  boundary.end_hessian.diagonal() << 50, 50, 50, 5, 0, 0;
  boundary.end_gradient << 1, -2, 0.5, 4, 0, 0;
  for (const unsigned seed : {9U, 10U}) expect_dense(some_cells(seed), boundary);
}

// A cell that nothing holds back has no least cost.
TEST(DenseRiccati, WhatHasNoMinimumIsNotSound) {
  std::vector<Cell> cells = some_cells(5);
  for (Cell& cell : cells) cell.hessian = -Matrix6::Identity();
  EXPECT_FALSE(solve_cells(cells, {}).sound);
}

}  // namespace
}  // namespace keyline::fairing::detail
