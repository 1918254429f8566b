#pragma once

namespace keyline::lac {

/// Curvature of a piece somewhere, and its derivatives by (curvature_start, curvature_end, alpha).
struct CurvatureValue {
  double curvature = 0;
  double by_start = 0;
  double by_end = 0;
  double by_alpha = 0;
};

/// Curvature along a piece by the fraction of its length, made ready to be read at many: what does
/// not depend on the fraction, most logarithms and powers, is worked out once.
///
/// Precondition: curvatures finite; alpha finite, and negative where the curvatures differ in sign
///               or one of them is zero (not checked). Stable for alpha near 0.
/// Source:       [QLAC] Eqs. 2-4: curvature is the power mean of exponent -alpha in arc length.
class PieceCurvature {
 public:
  PieceCurvature() = default;  ///< of a straight piece
  PieceCurvature(double curvature_start, double curvature_end, double alpha);

  /// v in [0, 1], the fraction of the length.
  CurvatureValue at(double v) const;
  double curvature(double v) const;

 private:
  /// log(1 + v (e^x - 1)) / x, and its derivative by x from its value: cumulants of a Bernoulli
  /// variable.
  double log_of_mean(double v) const;
  double rate_of_log(double v, double mean) const;
  CurvatureValue same_sign(double v) const;
  CurvatureValue through_zero(double v) const;

  double start_ = 0;  ///< curvatures, the other way round where `reversed_`
  double end_ = 0;
  bool same_sign_ = false;
  bool reversed_ = false;  ///< measured from the other end: the mean is the same

  double log_ratio_ = 0;  ///< of the curvatures, where they have one sign
  double x_ = 0;          ///< of that power's
  double exp_x_ = 0;
  double expm1_x_ = 0;

  double power_ = 1;  ///< -alpha, where curvature vanishes
  double scale_ = 0;
  double power_start_ = 0;  ///< of the curvatures by the scale
  double power_end_ = 0;
  double rate_start_ = 0;  ///< powers of one less
  double rate_end_ = 0;
  double log_start_ = 0;
  double log_end_ = 0;
};

/// The same at one place.
CurvatureValue curvature_with_derivatives(double curvature_start, double curvature_end,
                                          double alpha, double v);

}  // namespace keyline::lac
