#include "keyline/surface/hold_joints.h"

#include <cmath>

#include <Eigen/SparseCore>

#include "keyline/numeric/solve.h"
#include "keyline/surface/joint_conditions.h"

namespace keyline::surface {
namespace {

using detail::Form;

constexpr int kSweeps = 6;  ///< of refinement: conditions may repeat one another

/// The moves nearest to `wanted` for which all forms stay 0; columns of fixed points are left out.
Eigen::MatrixX3d admissible(Eigen::MatrixX3d moves, const std::vector<Form>& forms,
                            const std::vector<bool>& fixed) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::Index row = 0;
  for (const Form& form : forms) {
    double square = 0;
    for (const auto& [index, w] : form)
      if (!fixed[static_cast<std::size_t>(index)]) square += w * w;
    if (!(square > 0)) continue;
    for (const auto& [index, w] : form)
      if (w != 0 && !fixed[static_cast<std::size_t>(index)])
        entries.emplace_back(row, index, w / std::sqrt(square));
    ++row;
  }
  for (Eigen::Index i = 0; i < moves.rows(); ++i)
    if (fixed[static_cast<std::size_t>(i)]) moves.row(i).setZero();
  if (row == 0) return moves;
  Eigen::SparseMatrix<double> a(row, moves.rows());
  a.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> normal = a * a.transpose();
  for (Eigen::Index i = 0; i < row; ++i) normal.coeffRef(i, i) += 1e-10;  // repeated conditions
  const numeric::SparseSymmetric solver(normal);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    moves -= a.transpose() * solver.solve(Eigen::MatrixXd(a * moves));
  return moves;
}

}  // namespace

std::vector<BezierSurface> hold_joints(std::span<const BezierSurface> given,
                                       std::span<const BezierSurface> wanted,
                                       std::span<const HeldJoint> joints,
                                       const std::vector<std::vector<bool>>& fixed) {
  const Eigen::MatrixX3d before = detail::coordinates(given);
  std::vector<bool> still;
  for (std::size_t p = 0; p < given.size(); ++p)
    for (std::size_t i = 0; i < given[p].net.points.size(); ++i)
      still.push_back(p < fixed.size() && fixed[p][i]);
  return detail::with_coordinates(
      given, before + admissible(detail::coordinates(wanted) - before,
                                 detail::joint_conditions(given, joints), still));
}

}  // namespace keyline::surface
