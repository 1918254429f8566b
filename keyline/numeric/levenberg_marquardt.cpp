#include "keyline/numeric/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>

#include "keyline/numeric/damped_descent.h"
#include "keyline/numeric/solve.h"

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

/// A damped step: where it leads and what it gains.
struct Step {
  Eigen::VectorXd x;
  Eigen::VectorXd scaled;  // in the scaled unknowns
  double length = 0;
  double predicted = 0;  // decrease of the linearised cost
};

Eigen::VectorXd within(const Eigen::VectorXd& x, const LevenbergMarquardtOptions& bounds) {
  if (bounds.low.size() == 0) return x;
  return x.cwiseMax(bounds.low).cwiseMin(bounds.high);
}

/// Takes out the unknowns that are at a bound beyond which the cost would fall.
void hold_at_bounds(NormalEquations& normal, const Eigen::VectorXd& x,
                    const LevenbergMarquardtOptions& bounds) {
  if (bounds.low.size() == 0) return;
  for (int k = 0; k < x.size(); ++k) {
    const bool held = (x[k] <= bounds.low[k] && normal.gradient[k] > 0) ||
                      (x[k] >= bounds.high[k] && normal.gradient[k] < 0);
    if (!held) continue;
    normal.gradient[k] = 0;
    normal.matrix.row(k).setZero();
    normal.matrix.col(k).setZero();
    normal.matrix(k, k) = 1;
  }
}

Step damped_step(const NormalEquations& normal, double damping, const Eigen::VectorXd& x,
                 const LevenbergMarquardtOptions& bounds) {
  Eigen::MatrixXd damped = normal.matrix;
  damped.diagonal().array() += damping;
  Step step;
  step.scaled = solve_symmetric(damped, -normal.gradient);
  step.predicted = step.scaled.dot(damping * step.scaled - normal.gradient) / 2;
  Eigen::VectorXd move = normal.scale.cwiseProduct(step.scaled);
  step.x = x + move;
  if (bounds.low.size() > 0) {
    step.x = within(step.x, bounds);
    move = step.x - x;
    step.scaled = move.cwiseQuotient(normal.scale);
    step.predicted = -step.scaled.dot(normal.gradient + normal.matrix * step.scaled / 2);
  }
  step.length = move.norm();
  return step;
}

bool is_flat(const NormalEquations& normal, double cost, double tolerance) {
  return normal.gradient.lpNorm<Eigen::Infinity>() <= tolerance * std::sqrt(2 * cost);
}

}  // namespace

LevenbergMarquardtReport minimize_least_squares(const ResidualFunction& function,
                                                Eigen::VectorXd& x,
                                                const LevenbergMarquardtOptions& options) {
  LevenbergMarquardtReport report;
  x = within(x, options);
  Eigen::VectorXd residuals;
  Eigen::VectorXd trial_residuals;
  Eigen::MatrixXd jacobian;
  if (!function(x, residuals, &jacobian)) return report;
  report.cost = residuals.squaredNorm() / 2;
  report.status = LevenbergMarquardtStatus::iteration_limit;
  const auto equations = [&] {
    NormalEquations all = assemble(jacobian, residuals);
    hold_at_bounds(all, x, options);
    return all;
  };
  NormalEquations normal = equations();
  const auto flat = [&] { return is_flat(normal, report.cost, options.gradient_tolerance); };
  GainDamping rule{options.initial_damping};
  const auto take_step = [&](double damping) -> StepOutcome {
    const Step step = damped_step(normal, damping, x, options);
    if (step.length <= options.step_tolerance * (x.norm() + options.step_tolerance))
      return {StepEnd::settled};
    const bool inside = step.x.allFinite() && function(step.x, trial_residuals, nullptr);
    const double cost = inside ? trial_residuals.squaredNorm() / 2 : report.cost;
    const double gain = inside && std::isfinite(cost) ? (report.cost - cost) / step.predicted : -1;
    // A step cut off at a bound can be one that is predicted to be worse, and is.
    if (!(step.predicted > 0 && gain > 0)) return {};
    x = step.x;
    const bool settled = report.cost - cost <= options.cost_tolerance * report.cost;
    report.cost = cost;
    if (settled || !function(x, residuals, &jacobian)) return {StepEnd::settled};
    normal = equations();
    return {flat() ? StepEnd::settled : StepEnd::taken, gain};
  };
  const DescentEnd end = damped_descent(rule, flat() ? 0 : options.max_iterations, take_step);
  report.iterations = end.steps;
  if (end.settled || end.exhausted || end.steps == 0)
    report.status = LevenbergMarquardtStatus::converged;
  return report;
}

}  // namespace keyline::numeric
