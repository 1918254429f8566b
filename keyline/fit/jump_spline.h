#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include "keyline/core/point.h"
#include "keyline/curve/bspline.h"
#include "keyline/numeric/solve.h"

namespace keyline::fit::detail {

/// Points along a curve and their parameters, which rise from 0: to 1, or below it where the curve
/// is closed.
struct PlacedPoints {
  std::vector<core::Point2> points;
  std::vector<double> at;
  bool closed = false;
};

/// Quintic splines with given simple knots, of parameter and period 1 where they are closed. They
/// minimise
///   sum over points |S(at) - point|^2 + penalty * sum over knots (jump of S's fifth derivative)^2,
/// jumps over 5! and in a parameter in which knots are 1 apart in the mean; an open one has none at
/// its ends.
/// Source: [Dierckx 1993], ch. 5: the smoothing term of splines with few knots.
class JumpSpline {
 public:
  /// knots: numbers of the points at them, rising, the first and the last point's among them; a
  /// closed one's end with the number of points. The data are referred to.
  JumpSpline(const PlacedPoints& data, std::span<const std::size_t> knots);

  /// Makes spline() and offset() those of a penalty >= 0. False, and nothing of use there: the
  /// points do not determine the spline within rounding.
  bool solve(double penalty);

  const curve::BSpline2& spline() const { return spline_; }

  /// From a point to the spline at its parameter.
  core::Vector2 offset(std::size_t point) const;

 private:
  static constexpr int kDegree = 5;
  static constexpr int kOrder = kDegree + 1;
  using Products = std::array<std::array<double, kOrder>, kOrder>;

  void lay_knots(std::span<const std::size_t> knots);
  void gather(std::span<const std::size_t> knots);
  Products add_span(int k, std::size_t first, std::size_t last);
  void penalise();
  /// Of a point's span, the splines that are not 0 there, at the point.
  double basis(int spline, std::size_t point) const {
    return basis_[static_cast<std::size_t>(spline) * stride_ + point];
  }
  int unknown(int control) const { return data_.closed ? control % unknowns_ : control; }

  const PlacedPoints& data_;
  int spans_ = 0;
  int unknowns_ = 0;
  std::vector<int> span_;      ///< of every point
  std::vector<double> basis_;  ///< at every point, one spline of its span after another
  std::size_t stride_ = 0;
  Eigen::SparseMatrix<double> squares_;
  Eigen::SparseMatrix<double> jumps_;
  Eigen::MatrixXd right_;
  numeric::SparseSymmetric factor_;
  curve::BSpline2 spline_;
};

}  // namespace keyline::fit::detail
