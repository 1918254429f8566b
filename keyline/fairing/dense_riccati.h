#pragma once

#include <vector>

#include <Eigen/Core>

namespace keyline::fairing::detail {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What becomes of the two curvatures behind a cell.
struct Passage {
  bool ends_piece = false;  ///< the piece's end becomes the next one's start…
  bool arc = false;         ///< …but for an arc, whose end is its start
  bool ends_curve = false;  ///< there is no next piece whose end could be chosen
  bool fixed = false;       ///< the next piece's end may not change
};

/// One cell in the quadratic model: state (x, y, direction, curvature at the start and at the end
/// of its piece, length) of the joint before it; the end curvature of the next piece is the
/// control.
struct Cell {
  Matrix6 hessian = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  Eigen::Matrix<double, 3, 6> step = Eigen::Matrix<double, 3, 6>::Zero();  ///< next x, y, direction
  Eigen::Vector3d gap = Eigen::Vector3d::Zero();
  Passage passage;
};

/// What is held: rows of the start state that may not change, and a quadratic in the end state, or
/// in (end - start) where closed. The fifth row, a piece's end, is no part of either end.
struct DenseBoundary {
  bool closed = false;
  bool fixed_start[6] = {false, false, false, false, false, false};
  Matrix6 end_hessian = Matrix6::Zero();
  Vector6 end_gradient = Vector6::Zero();
};

struct DenseStep {
  std::vector<Vector6> state;  ///< one more than cells
  double largest_costate = 0;  ///< of x, y and direction: what a gap is worth
  bool sound = true;
};

/// Minimises the sum of the cells' quadratic models under their linear dynamics; linear in the
/// number of cells.
DenseStep solve_cells(const std::vector<Cell>& cells, const DenseBoundary& boundary);

}  // namespace keyline::fairing::detail
