#pragma once

#include <optional>
#include <span>

#include <Eigen/Dense>

#include "keyline/core/point.h"

namespace keyline::acquire::detail {

/// Polynomial over the principal direction of a few points, the other coordinate least squares
/// fitted. The frame follows the points, so that the fit does not depend on their pose.
class LocalFit {
 public:
  static constexpr int kMostPoints = 16;  ///< of a fit, which allocates nothing
  static constexpr int kMostTerms = 7;    ///< degree 6 at most

  /// Empty where points do not advance along the direction from first to last (a bend of more than
  /// a right angle, or noise larger than the spacing), or there are fewer points than terms.
  static std::optional<LocalFit> make(std::span<const core::Point2> points, int degree);

  /// Distance of p from the polynomial across the frame, signed.
  double residual(core::Point2 p) const;

  /// Sum of squared residuals of the fitted points.
  double squared_residuals() const { return squared_residuals_; }

 private:
  using Terms = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostTerms, 1>;

  core::Point2 origin_;
  core::Vector2 direction_;
  double scale_ = 1;
  Terms terms_;
  double squared_residuals_ = 0;
};

}  // namespace keyline::acquire::detail
