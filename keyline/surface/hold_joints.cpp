#include "keyline/surface/hold_joints.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

namespace {

/// The control points of an edge by their number among those of all patches, along its parameter.
std::vector<std::size_t> edge_points(const Net& net, std::size_t base, Edge edge) {
  const bool along_v = edge == Edge::u0 || edge == Edge::u1;
  const bool far = edge == Edge::u1 || edge == Edge::v1;
  std::vector<std::size_t> points;
  for (int i = 0; i < (along_v ? net.columns : net.rows); ++i)
    points.push_back(base + (along_v ? net.index(far ? net.rows - 1 : 0, i)
                                     : net.index(i, far ? net.columns - 1 : 0)));
  return points;
}

/// Sets of points that are one.
class Clusters {
 public:
  explicit Clusters(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t k) { parent_[of(i)] = of(k); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

void close_joints(std::span<const BezierSurface> given, std::span<const HeldJoint> joints,
                  std::vector<BezierSurface>& moved) {
  constexpr double kOne = 1e-12;
  std::vector<std::size_t> base{0};
  for (const BezierSurface& s : given) base.push_back(base.back() + s.net.points.size());
  const Eigen::MatrixX3d before = detail::coordinates(given);
  const auto apart = [&](std::size_t i, std::size_t k) {
    return (before.row(static_cast<Eigen::Index>(i)) - before.row(static_cast<Eigen::Index>(k)))
        .norm();
  };
  Clusters clusters(base.back());
  for (const HeldJoint& held : joints) {
    const auto [first, second, edges] = held.joint;
    const auto one = edge_points(given[first].net, base[first], edges[0]);
    auto two = edge_points(given[second].net, base[second], edges[1]);
    if (one.size() != two.size()) continue;
    if (apart(one.front(), two.front()) + apart(one.back(), two.back()) >
        apart(one.front(), two.back()) + apart(one.back(), two.front()))
      std::ranges::reverse(two);
    const double near = kOne * std::max(extent(given[first].net), extent(given[second].net));
    for (std::size_t i = 0; i < one.size(); ++i)
      if (apart(one[i], two[i]) <= near) clusters.join(one[i], two[i]);
  }
  Eigen::MatrixX3d after = detail::coordinates(moved);
  const auto row = [&](std::size_t i) { return after.row(static_cast<Eigen::Index>(i)); };
  for (std::size_t p = 0; p < given.size(); ++p)
    for (std::size_t i = base[p]; i < base[p + 1] && is_rational(given[p]); ++i)
      row(clusters.of(i)) = row(i);
  for (std::size_t i = 0; i < base.back(); ++i) row(i) = row(clusters.of(i));
  moved = detail::with_coordinates(moved, after);
  for (std::size_t p = 0; p < given.size(); ++p)
    if (is_rational(given[p])) moved[p] = given[p];
}

}  // namespace keyline::surface
