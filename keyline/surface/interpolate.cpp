#include "keyline/surface/interpolate.h"

#include <Eigen/LU>

#include "keyline/surface/tensor.h"

namespace keyline::surface::detail {

std::vector<double> averaged_knots(std::span<const double> places, int degree) {
  const int n = static_cast<int>(places.size());
  std::vector<double> knots(degree + 1, 0.0);
  for (int i = 1; i < n - degree; ++i) {
    double sum = 0;
    for (int k = i; k < i + degree; ++k) sum += places[k];
    knots.push_back(sum / degree);
  }
  knots.insert(knots.end(), degree + 1, 1.0);
  return knots;
}

std::vector<std::vector<core::Vector3>> interpolate(
    std::span<const double> places, std::span<const double> knots, int degree,
    const std::vector<std::vector<core::Vector3>>& values) {
  const auto n = static_cast<Eigen::Index>(places.size());
  const auto columns = static_cast<Eigen::Index>(values.front().size());
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd wanted(n, 3 * columns);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Basis b = spline_basis(degree, knots, places[i]);
    for (int k = 0; k < b.count; ++k) basis(i, b.first + k) = b.values[0][k];
    for (Eigen::Index j = 0; j < columns; ++j) {
      const core::Vector3& v = values[i][j];
      wanted.block<1, 3>(i, 3 * j) << v.x, v.y, v.z;
    }
  }
  const Eigen::MatrixXd control = basis.partialPivLu().solve(wanted);
  std::vector<std::vector<core::Vector3>> result(places.size());
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < columns; ++j)
      result[i].push_back({control(i, 3 * j), control(i, 3 * j + 1), control(i, 3 * j + 2)});
  return result;
}

}  // namespace keyline::surface::detail
