#include "keyline/surface/reduce.h"

#include <algorithm>

#include <Eigen/Core>

#include "keyline/numeric/solve.h"
#include "keyline/surface/tensor.h"

namespace keyline::surface {
namespace {

constexpr int kPlaces = 33;

Eigen::MatrixXd bernstein_matrix(int degree) {
  Eigen::MatrixXd b(kPlaces, degree + 1);
  for (int i = 0; i < kPlaces; ++i) {
    const auto basis = detail::bernstein_basis(degree, i / double{kPlaces - 1});
    for (int k = 0; k <= degree; ++k) b(i, k) = basis.values[0][static_cast<std::size_t>(k)];
  }
  return b;
}

bool is_corner(const Net& net, int i, int j) {
  return (i == 0 || i == net.rows - 1) && (j == 0 || j == net.columns - 1);
}

}  // namespace

BezierSurface reduced_degree(const BezierSurface& s, int degree_u, int degree_v) {
  const int p = s.net.rows - 1;
  const int q = s.net.columns - 1;
  if (p <= degree_u && q <= degree_v) return elevate_degree(s, degree_u - p, degree_v - q);
  BezierSurface r{{degree_u + 1, degree_v + 1, {}}, {}};
  r.net.points.resize(static_cast<std::size_t>(r.net.rows * r.net.columns));
  for (const int i : {0, 1})
    for (const int j : {0, 1}) r.net.at(i * degree_u, j * degree_v) = s.net.at(i * p, j * q);
  const Eigen::MatrixXd bu = bernstein_matrix(degree_u);
  const Eigen::MatrixXd bv = bernstein_matrix(degree_v);
  const int count = kPlaces * kPlaces;
  Eigen::MatrixXd basis(count, r.net.rows * r.net.columns - 4);
  Eigen::MatrixXd wanted(count, 3);
  for (int k = 0; k < count; ++k) {
    const int a = k / kPlaces;
    const int b = k % kPlaces;
    core::Vector3 left =
        evaluate(s, a / double{kPlaces - 1}, b / double{kPlaces - 1}) - core::Point3{};
    int column = 0;
    for (int i = 0; i < r.net.rows; ++i)
      for (int j = 0; j < r.net.columns; ++j) {
        const double weight = bu(a, i) * bv(b, j);
        if (is_corner(r.net, i, j))
          left = left - weight * (r.net.at(i, j) - core::Point3{});
        else
          basis(k, column++) = weight;
      }
    wanted.row(k) << left.x, left.y, left.z;
  }
  const Eigen::MatrixXd found = numeric::pivoted_least_squares(basis, wanted);
  int row = 0;
  for (int i = 0; i < r.net.rows; ++i)
    for (int j = 0; j < r.net.columns; ++j) {
      if (is_corner(r.net, i, j)) continue;
      r.net.at(i, j) = {found(row, 0), found(row, 1), found(row, 2)};
      ++row;
    }
  return r;
}

}  // namespace keyline::surface
