#pragma once

#include <array>

#include <Eigen/Core>

#include "keyline/fit/quintic_joints.h"

namespace keyline::fit {

/// Least squares of a quintic, gathered by its control points: what holds places of the curve is
/// summed in few numbers, and only the sums are brought to the piece's twelve unknowns.
class QuinticNormal {
 public:
  using Matrix = Eigen::Matrix<double, 12, 12>;
  using Row = Eigen::Matrix<double, 12, 1>;

  /// At t: a weight on how far the place moves along `across`, squared, and a pull along it, both
  /// for an `across` of length 1.
  void add_place(double t, core::Vector2 across, double weight, double pull);

  /// Wanted: the sum of dot(by[k], how control point k moves) = value.
  void add_row(const std::array<core::Vector2, 6>& by, double value);

  /// Matrix and right hand side in the unknowns of this piece (QuinticRow's): places at that price,
  /// rows as they are.
  void gather(const JointedQuintic& piece, double price, Matrix& matrix, Row& wanted) const;

 private:
  // Products of Bernstein polynomials of degree 5 are those of degree 10, each but for a constant:
  // eleven of them times xx, xy and yy of the directions are all of a place's part of the matrix.
  // One more, always 0, makes their number even: they are summed two by two.
  using Sums = Eigen::Array<double, 12, 1>;
  Sums xx_ = Sums::Zero();
  Sums xy_ = Sums::Zero();
  Sums yy_ = Sums::Zero();
  Eigen::Array<double, 6, 1> pull_x_ = Eigen::Array<double, 6, 1>::Zero();
  Eigen::Array<double, 6, 1> pull_y_ = Eigen::Array<double, 6, 1>::Zero();
  Matrix rows_ = Matrix::Zero();
  Row rows_wanted_ = Row::Zero();
};

}  // namespace keyline::fit
