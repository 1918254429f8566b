#include "keyline/fit/quintic_normal.h"

#include <cstddef>

namespace keyline::fit {
namespace {

using core::Vector2;

/// Where the two coordinates of a control point stand.
constexpr Eigen::Index row_of(std::size_t control) {
  return static_cast<Eigen::Index>(2 * control);
}

/// Slopes of the control points' coordinates by the piece's unknowns.
QuinticNormal::Matrix slopes_of(const JointedQuintic& piece) {
  QuinticNormal::Matrix slopes;
  for (std::size_t k = 0; k < 6; ++k) {
    QuinticWeights one{};
    one[k] = 1;
    const QuinticRow by = sensitivity(piece, one);
    for (std::size_t c = 0; c < 12; ++c) {
      slopes(row_of(k), static_cast<Eigen::Index>(c)) = by[c].x;
      slopes(row_of(k) + 1, static_cast<Eigen::Index>(c)) = by[c].y;
    }
  }
  return slopes;
}

}  // namespace

void QuinticNormal::add_place(double t, Vector2 across, double weight, double pull) {
  const double u = 1 - t;
  std::array<double, 11> up;    // powers of t
  std::array<double, 11> down;  // of 1 - t
  up[0] = down[0] = 1;
  for (std::size_t m = 1; m < 11; ++m) {
    up[m] = up[m - 1] * t;
    down[m] = down[m - 1] * u;
  }
  const double xx = weight * across.x * across.x;
  const double xy = weight * across.x * across.y;
  const double yy = weight * across.y * across.y;
  for (std::size_t m = 0; m < 11; ++m) {
    const double b = up[m] * down[10 - m];
    squares_[m][0] += b * xx;
    squares_[m][1] += b * xy;
    squares_[m][2] += b * yy;
  }
  const Vector2 pulled = pull * across;
  for (std::size_t k = 0; k < 6; ++k) pulls_[k] = pulls_[k] + (up[k] * down[5 - k]) * pulled;
}

void QuinticNormal::add_row(const std::array<Vector2, 6>& by, double value) {
  Row row;
  for (std::size_t k = 0; k < 6; ++k) {
    row[row_of(k)] = by[k].x;
    row[row_of(k) + 1] = by[k].y;
  }
  rows_.noalias() += row * row.transpose();
  rows_wanted_ += value * row;
}

void QuinticNormal::gather(const JointedQuintic& piece, double price, Matrix& matrix,
                           Row& wanted) const {
  Matrix controls = rows_;
  Row pulls = rows_wanted_;
  for (std::size_t k = 0; k < 6; ++k) {
    const Eigen::Index r = row_of(k);
    for (std::size_t l = 0; l < 6; ++l) {
      const Eigen::Index c = row_of(l);
      const double times = price * kChoose5[k] * kChoose5[l];
      controls(r, c) += times * squares_[k + l][0];
      controls(r, c + 1) += times * squares_[k + l][1];
      controls(r + 1, c) += times * squares_[k + l][1];
      controls(r + 1, c + 1) += times * squares_[k + l][2];
    }
    pulls[r] += price * kChoose5[k] * pulls_[k].x;
    pulls[r + 1] += price * kChoose5[k] * pulls_[k].y;
  }
  const Matrix slopes = slopes_of(piece);
  const Matrix half = controls * slopes;
  matrix.noalias() = slopes.transpose() * half;
  wanted.noalias() = slopes.transpose() * pulls;
}

}  // namespace keyline::fit
