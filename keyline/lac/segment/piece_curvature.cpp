#include "keyline/lac/segment/piece_curvature.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/numeric/power_mean.h"

namespace keyline::lac {
namespace {

constexpr double kFarPower = 30;     // logarithm from which the mean is measured from the other end
constexpr double kNearPower = 1e-3;  // …and below which it is a series
constexpr double kLeast = 1e-9;      // of the larger curvature, for powers of one that is zero
constexpr double kLeastMean = 1e-12;

}  // namespace

PieceCurvature::PieceCurvature(double curvature_start, double curvature_end, double alpha)
    : start_(curvature_start),
      end_(curvature_end),
      same_sign_(curvature_start * curvature_end > 0),
      power_(-alpha) {
  if (same_sign_) {
    log_ratio_ = std::log(end_ / start_);
    x_ = power_ * log_ratio_;
    if (x_ > kFarPower) {
      reversed_ = true;
      std::swap(start_, end_);
      log_ratio_ = std::log(end_ / start_);
      x_ = power_ * log_ratio_;
    }
    exp_x_ = std::exp(x_);
    expm1_x_ = std::expm1(x_);
    return;
  }
  scale_ = std::max(std::abs(start_), std::abs(end_));
  if (scale_ == 0) return;
  const double a = start_ / scale_;
  const double b = end_ / scale_;
  power_start_ = numeric::signed_power(a, power_);
  power_end_ = numeric::signed_power(b, power_);
  rate_start_ = std::pow(a == 0 ? kLeast : std::abs(a), power_ - 1);
  rate_end_ = std::pow(b == 0 ? kLeast : std::abs(b), power_ - 1);
  log_start_ = std::log(std::max(std::abs(a), 1e-300));
  log_end_ = std::log(std::max(std::abs(b), 1e-300));
}

double PieceCurvature::log_of_mean(double v) const {
  const double x = x_;
  if (std::abs(x) < kNearPower) {
    const double k2 = v * (1 - v);
    const double k3 = k2 * (1 - 2 * v);
    const double k4 = k2 * (1 - 6 * k2);
    return v + x * (k2 / 2 + x * (k3 / 6 + x * k4 / 24));
  }
  if (x < -1) {  // no cancellation here, and v = 1 gives x itself
    const double z = (1 - v) + v * exp_x_;
    return z > 0 ? std::log(z) / x : 1;
  }
  return std::log1p(v * expm1_x_) / x;
}

double PieceCurvature::rate_of_log(double v, double g) const {
  const double x = x_;
  if (std::abs(x) < kNearPower) {
    const double k2 = v * (1 - v);
    const double k3 = k2 * (1 - 2 * v);
    const double k4 = k2 * (1 - 6 * k2);
    return k2 / 2 + x * (k3 / 3 + x * k4 / 8);
  }
  if (x < -1) {
    const double last = v * exp_x_;
    const double z = (1 - v) + last;
    return ((z > 0 ? last / z : 1) - g) / x;
  }
  return (v * (1 + expm1_x_) / (1 + v * expm1_x_) - g) / x;
}

CurvatureValue PieceCurvature::same_sign(double v) const {
  const double g = log_of_mean(v);
  CurvatureValue r;
  r.curvature = start_ * std::exp(log_ratio_ * g);
  const double last = v * exp_x_;
  const double z = (1 - v) + last;
  r.by_start = z > 0 ? r.curvature * (1 - v) / z / start_ : 0;
  r.by_end = r.curvature * (z > 0 ? last / z : 1) / end_;
  r.by_alpha = -r.curvature * log_ratio_ * log_ratio_ * rate_of_log(v, g);
  return r;
}

CurvatureValue PieceCurvature::through_zero(double v) const {
  CurvatureValue r;
  if (scale_ == 0) {
    r.by_start = 1 - v;
    r.by_end = v;
    return r;
  }
  const double z = (1 - v) * power_start_ + v * power_end_;
  r.curvature = scale_ * numeric::signed_power(z, 1 / power_);
  const double zz = std::max(std::abs(z), kLeastMean);
  const double outer = std::pow(zz, 1 / power_ - 1);
  r.by_start = (1 - v) * rate_start_ * outer;
  r.by_end = v * rate_end_ * outer;
  const double dz = (1 - v) * power_start_ * log_start_ + v * power_end_ * log_end_;
  r.by_alpha = -(r.curvature * (-std::log(zz) / (power_ * power_)) + scale_ * outer * dz / power_);
  return r;
}

CurvatureValue PieceCurvature::at(double v) const {
  if (!same_sign_) return through_zero(v);
  if (!reversed_) return same_sign(v);
  CurvatureValue r = same_sign(1 - v);
  std::swap(r.by_start, r.by_end);
  return r;
}

double PieceCurvature::curvature(double v) const {
  if (same_sign_) return start_ * std::exp(log_ratio_ * log_of_mean(reversed_ ? 1 - v : v));
  if (scale_ == 0) return 0;
  return scale_ * numeric::signed_power((1 - v) * power_start_ + v * power_end_, 1 / power_);
}

CurvatureValue curvature_with_derivatives(double curvature_start, double curvature_end,
                                          double alpha, double v) {
  return PieceCurvature(curvature_start, curvature_end, alpha).at(v);
}

}  // namespace keyline::lac
