#pragma once

#include <Eigen/Core>

/// Internals: both ends of a backward sweep over states of N numbers. For a closed curve they are
/// twice as many, the second half the start state, so that the end can be tied to it.
namespace keyline::fairing::detail {

template <int N>
struct QuadraticModel {
  Eigen::Matrix<double, N, N> hessian;
  Eigen::Matrix<double, N, 1> gradient;
};

/// Sets the model of all S numbers to one of the end state, or of (end - start).
template <int N, int S>
void set_end_model(const Eigen::Matrix<double, N, N>& hessian,
                   const Eigen::Matrix<double, N, 1>& gradient, Eigen::Matrix<double, S, S>& value,
                   Eigen::Matrix<double, S, 1>& slope) {
  value.setZero();
  slope.setZero();
  value.template topLeftCorner<N, N>() = hessian;
  slope.template head<N>() = gradient;
  if constexpr (S == 2 * N) {
    value.template bottomRightCorner<N, N>() = hessian;
    value.template topRightCorner<N, N>() = -hessian;
    value.template bottomLeftCorner<N, N>() = -hessian;
    slope.template tail<N>() = -gradient;
  }
}

/// The model of the start state alone, where both halves are the same unknown; rows that are fixed
/// ask for no change.
template <int N, int S>
QuadraticModel<N> start_model(const Eigen::Matrix<double, S, S>& value,
                              const Eigen::Matrix<double, S, 1>& slope, const bool (&fixed)[N]) {
  QuadraticModel<N> start{value.template topLeftCorner<N, N>(), slope.template head<N>()};
  if constexpr (S == 2 * N) {
    start.hessian += value.template bottomRightCorner<N, N>();
    start.hessian += value.template topRightCorner<N, N>();
    start.hessian += value.template bottomLeftCorner<N, N>();
    start.gradient += slope.template tail<N>();
  }
  for (int k = 0; k < N; ++k) {
    if (!fixed[k]) continue;
    start.hessian.row(k).setZero();
    start.hessian.col(k).setZero();
    start.hessian(k, k) = 1;
    start.gradient(k) = 0;
  }
  return start;
}

}  // namespace keyline::fairing::detail
