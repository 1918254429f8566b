#include "keyline/acquire/local_fit.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/second_moments.h"

namespace keyline::acquire::detail {
namespace {

/// Unit principal direction of the points, pointing from first to last.
core::Vector2 principal_direction(std::span<const core::Point2> points, core::Point2 mean) {
  core::SecondMoments moments;
  for (const core::Point2& p : points) moments.add(p - mean);
  const core::Vector2 v = moments.direction();
  return core::dot(v, points.back() - points.front()) < 0 ? -v : v;
}

}  // namespace

std::optional<LocalFit> LocalFit::make(std::span<const core::Point2> points, int degree) {
  const int n = static_cast<int>(points.size());
  if (n > kMostPoints || degree + 1 > std::min(n, kMostTerms)) return std::nullopt;
  LocalFit fit;
  core::Vector2 sum;
  for (const core::Point2& p : points) sum = sum + (p - points[0]);
  fit.origin_ = points[0] + sum / n;
  fit.direction_ = principal_direction(points, fit.origin_);
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostPoints, 1>;
  Columns x(n), y(n);
  for (int i = 0; i < n; ++i) {
    const core::Vector2 d = points[static_cast<std::size_t>(i)] - fit.origin_;
    x[i] = core::dot(fit.direction_, d);
    y[i] = core::cross(fit.direction_, d);
    if (i > 0 && x[i] <= x[i - 1]) return std::nullopt;
  }
  fit.scale_ = x.cwiseAbs().maxCoeff();
  if (!(fit.scale_ > 0)) return std::nullopt;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostPoints, kMostTerms> a(n,
                                                                                      degree + 1);
  a.col(0).setOnes();
  for (int k = 1; k <= degree; ++k) a.col(k) = a.col(k - 1).cwiseProduct(x / fit.scale_);
  fit.terms_ = a.householderQr().solve(y);
  fit.squared_residuals_ = (a * fit.terms_ - y).squaredNorm();
  return fit;
}

double LocalFit::residual(core::Point2 p) const {
  const core::Vector2 d = p - origin_;
  const double x = core::dot(direction_, d) / scale_;
  double value = 0;
  for (Eigen::Index k = terms_.size() - 1; k >= 0; --k) value = value * x + terms_[k];
  return core::cross(direction_, d) - value;
}

}  // namespace keyline::acquire::detail
