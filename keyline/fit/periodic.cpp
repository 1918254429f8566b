#include "keyline/fit/periodic.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "keyline/curve/bspline.h"
#include "keyline/numeric/solve.h"

namespace keyline::fit::detail {
namespace {

/// The knots continued periodically: index may be negative.
double periodic_knot(const std::vector<double>& knots, std::ptrdiff_t index) {
  const auto n = static_cast<std::ptrdiff_t>(knots.size());
  const std::ptrdiff_t turns = index >= 0 ? index / n : -((n - 1 - index) / n);
  return knots[static_cast<std::size_t>(index - turns * n)] + static_cast<double>(turns);
}

/// Clamped coefficients on [0, 1] as a linear map of the periodic ones, one column for each.
Eigen::MatrixXd clamping(const std::vector<double>& knots, int degree) {
  const auto n = static_cast<std::ptrdiff_t>(knots.size());
  std::ptrdiff_t low = -1;  // the last knot not after 0, the first not before 1
  while (periodic_knot(knots, low + 1) <= 0) ++low;
  std::ptrdiff_t high = n;
  while (periodic_knot(knots, high - 1) >= 1) --high;
  curve::BSpline2 basis;
  basis.degree = degree;
  for (std::ptrdiff_t i = low - degree; i <= high + degree; ++i) {
    basis.knots.push_back(periodic_knot(knots, i));
  }
  const std::ptrdiff_t count = high - low + degree;
  const auto interior = std::count_if(knots.begin(), knots.end(), [](double t) { return t > 0; });
  Eigen::MatrixXd map(interior + degree + 1, n);
  for (std::ptrdiff_t j = 0; j < n; ++j) {
    basis.control.assign(static_cast<std::size_t>(count), {0, 0});
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      if (((low - degree + i - j) % n + n) % n == 0)
        basis.control[static_cast<std::size_t>(i)].x = 1;
    }
    const curve::BSpline2 clamped = curve::subcurve(basis, curve::parameter_at_knot(basis, 0.0),
                                                    curve::parameter_at_knot(basis, 1.0));
    for (std::ptrdiff_t i = 0; i < map.rows(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      map(i, j) = at < clamped.control.size() ? clamped.control[at].x : 0;
    }
  }
  return map;
}

}  // namespace

/// The banded triangle R and coefficients c of the open spline turn the periodic problem, with
/// clamped coefficients T p, into min |R (T p - c)|: small and dense.
std::optional<LeastSquaresSpline> periodic_spline(const SplineData& data,
                                                  const std::vector<double>& knots, int order) {
  std::vector<double> interior;
  std::copy_if(knots.begin(), knots.end(), std::back_inserter(interior),
               [](double t) { return t > 0; });
  SplineSolver solver(data, {0, 1}, order);
  if (knots.empty() || !solver.solve(interior)) return std::nullopt;
  const Eigen::MatrixXd map = clamping(knots, order - 1);
  const Eigen::Index rows = map.rows();
  const auto columns = static_cast<Eigen::Index>(data.columns.size());
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(rows, rows);
  Eigen::MatrixXd open(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = i; j < std::min(rows, i + order); ++j) {
      triangle(i, j) = solver.triangle(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
    }
    for (Eigen::Index k = 0; k < columns; ++k) {
      open(i, k) = solver.coefficient(static_cast<std::size_t>(i), static_cast<std::size_t>(k));
    }
  }
  const Eigen::MatrixXd periodic = numeric::pivoted_least_squares(triangle * map, triangle * open);
  if (!periodic.allFinite()) return std::nullopt;
  const Eigen::MatrixXd clamped = map * periodic;
  LeastSquaresSpline result;
  result.order = order;
  result.knots.assign(solver.knots().begin(), solver.knots().end());
  for (Eigen::Index k = 0; k < columns; ++k) {
    result.coefficients.emplace_back(clamped.col(k).begin(), clamped.col(k).end());
  }
  return result;
}

}  // namespace keyline::fit::detail
