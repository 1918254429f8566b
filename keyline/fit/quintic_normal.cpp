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
  using Pair = Eigen::Array2d;
  const double u = 1 - t;
  std::array<Pair, 6> up;    // powers of t, from the first on …
  std::array<Pair, 6> down;  // … and of 1 - t, from the tenth down
  up[0] = {1, t};
  down[5] = {1, 0};
  down[4] = {u * u, u};
  for (std::size_t i = 1; i < 6; ++i) up[i] = up[i - 1] * (t * t);
  for (std::size_t i = 4; i-- > 0;) down[i] = down[i + 1] * (u * u);
  const Vector2 heavy = weight * across;
  for (std::size_t i = 0; i < 6; ++i) {
    const Pair both = up[i] * down[i];
    const auto at = static_cast<Eigen::Index>(2 * i);
    xx_.segment<2>(at) += both * (heavy.x * across.x);
    xy_.segment<2>(at) += both * (heavy.x * across.y);
    yy_.segment<2>(at) += both * (heavy.y * across.y);
  }
  const Vector2 pulled = pull * across;
  const std::array<Pair, 3> fifth = {up[0] * (u * down[3]), up[1] * (u * down[4]),
                                     up[2] * Pair(u, 1)};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = static_cast<Eigen::Index>(2 * i);
    pull_x_.segment<2>(at) += fifth[i] * pulled.x;
    pull_y_.segment<2>(at) += fifth[i] * pulled.y;
  }
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
      const auto sum = static_cast<Eigen::Index>(k + l);
      const double times = price * kChoose5[k] * kChoose5[l];
      controls(r, c) += times * xx_[sum];
      controls(r, c + 1) += times * xy_[sum];
      controls(r + 1, c) += times * xy_[sum];
      controls(r + 1, c + 1) += times * yy_[sum];
    }
    pulls[r] += price * kChoose5[k] * pull_x_[r / 2];
    pulls[r + 1] += price * kChoose5[k] * pull_y_[r / 2];
  }
  const Matrix slopes = slopes_of(piece);
  const Matrix half = controls * slopes;
  matrix.noalias() = slopes.transpose() * half;
  wanted.noalias() = slopes.transpose() * pulls;
}

}  // namespace keyline::fit
