#include "keyline/numeric/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace keyline::numeric {
namespace {

/// Normal equations of the linearised problem, columns scaled to unit length.
struct NormalEquations {
  Eigen::VectorXd scale;
  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;  // scaled
};

NormalEquations assemble(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals) {
  NormalEquations n;
  n.scale = jacobian.colwise().norm().transpose();
  for (double& s : n.scale) s = s > 0 ? 1 / s : 1;
  n.matrix = Eigen::MatrixXd::Zero(jacobian.cols(), jacobian.cols());
  n.matrix.selfadjointView<Eigen::Lower>().rankUpdate(jacobian.transpose());
  n.matrix = n.matrix.selfadjointView<Eigen::Lower>();
  n.matrix = n.scale.asDiagonal() * n.matrix * n.scale.asDiagonal();
  n.gradient = n.scale.cwiseProduct(jacobian.transpose() * residuals);
  return n;
}

}  // namespace

LevenbergMarquardtReport minimize_least_squares(const ResidualFunction& function,
                                                Eigen::VectorXd& x,
                                                const LevenbergMarquardtOptions& options) {
  LevenbergMarquardtReport report;
  Eigen::VectorXd residuals;
  Eigen::VectorXd trial_residuals;
  Eigen::MatrixXd jacobian;
  if (!function(x, residuals, &jacobian)) return report;
  report.cost = residuals.squaredNorm() / 2;
  report.status = LevenbergMarquardtStatus::iteration_limit;
  NormalEquations normal = assemble(jacobian, residuals);
  double damping = options.initial_damping;
  double growth = 2;
  while (report.iterations < options.max_iterations) {
    if (normal.gradient.lpNorm<Eigen::Infinity>() <=
        options.gradient_tolerance * std::sqrt(2 * report.cost)) {
      report.status = LevenbergMarquardtStatus::converged;
      break;
    }
    ++report.iterations;
    Eigen::MatrixXd damped = normal.matrix;
    damped.diagonal().array() += damping;
    const Eigen::VectorXd scaled = damped.ldlt().solve(-normal.gradient);
    const Eigen::VectorXd step = normal.scale.cwiseProduct(scaled);
    if (step.norm() <= options.step_tolerance * (x.norm() + options.step_tolerance)) {
      report.status = LevenbergMarquardtStatus::converged;
      break;
    }
    const Eigen::VectorXd trial = x + step;
    const bool inside = trial.allFinite() && function(trial, trial_residuals, nullptr);
    const double cost = inside ? trial_residuals.squaredNorm() / 2 : report.cost;
    const double predicted = scaled.dot(damping * scaled - normal.gradient) / 2;
    const double gain = inside && std::isfinite(cost) ? (report.cost - cost) / predicted : -1;
    if (!(gain > 0)) {
      damping *= growth;
      growth *= 2;
      if (damping > 1e16) {
        report.status = LevenbergMarquardtStatus::converged;
        break;
      }
      continue;
    }
    const double decrease = report.cost - cost;
    x = trial;
    damping = std::max(1e-15, damping * std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3)));
    growth = 2;
    const bool settled = decrease <= options.cost_tolerance * report.cost;
    report.cost = cost;
    if (settled || !function(x, residuals, &jacobian)) {
      report.status = LevenbergMarquardtStatus::converged;
      break;
    }
    normal = assemble(jacobian, residuals);
  }
  return report;
}

}  // namespace keyline::numeric
