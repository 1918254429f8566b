#include "keyline/fit/knot_positions.h"

#include <algorithm>

#include <Eigen/Core>

#include "keyline/numeric/levenberg_marquardt.h"
#include "keyline/numeric/parallel.h"

namespace keyline::fit::detail {
namespace {

using Groups = std::vector<KnotGroup>;

/// Residuals as a function of the positions of the groups [first, last).
class PositionProblem {
 public:
  PositionProblem(std::span<SplineSolver> solvers, const Groups& groups, std::size_t first,
                  std::size_t last)
      : solvers_(solvers), groups_(groups), first_(first), last_(last) {}

  bool operator()(const Eigen::VectorXd& at, Eigen::VectorXd& residuals,
                  Eigen::MatrixXd* jacobian) const {
    const Groups moved = moved_to(at);
    for (std::size_t i = 1; i < moved.size(); ++i) {
      if (!(moved[i].at > moved[i - 1].at)) return false;
    }
    SplineSolver& solver = solvers_[0];
    const std::size_t size = solver.data_count() * solver.column_count();
    residuals.resize(static_cast<Eigen::Index>(size));
    if (!solver.solve_near_data(flattened(moved))) return false;
    solver.residuals({residuals.data(), size});
    if (jacobian == nullptr) return true;
    jacobian->setZero(residuals.size(), at.size());
    numeric::parallel_for(
        last_ - first_, static_cast<int>(solvers_.size()), [&](std::size_t task, int worker) {
          const std::size_t i = last_ - first_ - 1 - task;  // a solver goes on where knots part
          difference(solvers_[static_cast<std::size_t>(worker)], moved, first_ + i, residuals,
                     jacobian->col(static_cast<Eigen::Index>(i)));
        });
    return true;
  }

  Groups moved_to(const Eigen::VectorXd& at) const {
    Groups moved = groups_;
    for (std::size_t i = first_; i < last_; ++i) {
      moved[i].at = at[static_cast<Eigen::Index>(i - first_)];
    }
    return moved;
  }

 private:
  /// Forward difference by the position of one group; zero where it cannot move.
  static void difference(SplineSolver& solver, Groups moved, std::size_t group,
                         const Eigen::VectorXd& residuals, Eigen::Ref<Eigen::VectorXd> column) {
    const double at = moved[group].at;
    const double next = group + 1 < moved.size() ? moved[group + 1].at : solver.domain().high;
    moved[group].at = at + std::min(1e-6, 0.25 * (next - at));
    if (!(moved[group].at > at) || !solver.solve(flattened(moved))) return;
    solver.residuals({column.data(), static_cast<std::size_t>(column.size())});
    column = (column - residuals) / (moved[group].at - at);
  }

  std::span<SplineSolver> solvers_;
  const Groups& groups_;
  std::size_t first_;
  std::size_t last_;
};

}  // namespace

std::vector<KnotGroup> grouped(const std::vector<double>& knots) {
  Groups groups;
  for (const double t : knots) {
    if (!groups.empty() && groups.back().at == t) {
      ++groups.back().multiplicity;
    } else {
      groups.push_back({t, 1});
    }
  }
  return groups;
}

std::vector<double> flattened(const std::vector<KnotGroup>& groups) {
  std::vector<double> knots;
  for (const KnotGroup& g : groups) knots.insert(knots.end(), g.multiplicity, g.at);
  return knots;
}

std::vector<KnotGroup> optimise_positions(std::span<SplineSolver> solvers,
                                          std::vector<KnotGroup> groups, std::size_t first,
                                          std::size_t last, int iterations) {
  if (first >= last) return groups;
  Eigen::VectorXd x(static_cast<Eigen::Index>(last - first));
  for (std::size_t i = first; i < last; ++i) {
    x[static_cast<Eigen::Index>(i - first)] = groups[i].at;
  }
  numeric::LevenbergMarquardtOptions options;
  options.max_iterations = iterations;
  options.step_tolerance = 1e-9;
  options.cost_tolerance = 1e-9;
  const PositionProblem problem(solvers, groups, first, last);
  numeric::minimize_least_squares(problem, x, options);
  return problem.moved_to(x);
}

}  // namespace keyline::fit::detail
