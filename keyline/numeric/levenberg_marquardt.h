#pragma once

#include <functional>

#include <Eigen/Core>

namespace keyline::numeric {

/// Fills residuals (fixed size over all calls) and, where it is not null, the Jacobian
/// d residual_i / d x_j. Returns false where x lies outside the domain: the step is then shortened.
using ResidualFunction = std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd& residuals,
                                            Eigen::MatrixXd* jacobian)>;

struct LevenbergMarquardtOptions {
  int max_iterations = 100;           ///< accepted or rejected steps
  double initial_damping = 1e-3;      ///< relative to the scaled normal matrix
  double gradient_tolerance = 1e-12;  ///< largest cosine between residual and a Jacobian column
  double step_tolerance = 1e-12;      ///< |step| relative to |x|
  double cost_tolerance = 1e-14;      ///< relative decrease of the cost
  Eigen::VectorXd low{};              ///< x stays from low to high; empty: without bounds
  Eigen::VectorXd high{};
};

enum class LevenbergMarquardtStatus { converged, iteration_limit, no_start };

struct LevenbergMarquardtReport {
  LevenbergMarquardtStatus status = LevenbergMarquardtStatus::no_start;
  int iterations = 0;
  double cost = 0;  ///< half the sum of squared residuals at the returned x
};

/// Minimises half the sum of squared residuals, starting at x and leaving the best point in x.
///
/// Damped normal equations with the columns scaled to unit length ([Marquardt 1963]) and the gain
/// ratio controlling the damping ([Nielsen 1999]). For small and moderate dense problems; a rank
/// deficient Jacobian is harmless (the damping regularises it), but precision of x is then
/// limited to about the square root of rounding. Bounds: steps end at them, and an unknown that is
/// at one and would pass it stays there while the others move. no_start: the function refused the
/// start, x is untouched.
LevenbergMarquardtReport minimize_least_squares(const ResidualFunction& function,
                                                Eigen::VectorXd& x,
                                                const LevenbergMarquardtOptions& options = {});

}  // namespace keyline::numeric
