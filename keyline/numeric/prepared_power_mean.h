#pragma once

#include "keyline/numeric/power_mean.h"

namespace keyline::numeric {

/// power_mean(a, b, p, .) made ready for many u; the same values to the last bits.
class PowerMean {
 public:
  PowerMean(double a, double b, double p) : a_(a), b_(b), p_(p) {
    regular_ = a > 0 && b > 0 && !std::isinf(a) && !std::isinf(b) && a != b;
    if (!regular_) return;
    l_ = log_ratio(a, b);
    x_ = p * l_;
    regular_ = std::abs(x_) >= 1e-300;
    blend_ = std::expm1(-std::abs(x_));
    end_ = std::exp(-std::abs(x_));
  }

  double operator()(double u) const {
    if (!regular_ || u <= 0 || u >= 1) return power_mean(a_, b_, p_, u);
    const double w = x_ > 0 ? 1 - u : u;
    const double y = w * blend_;
    const double log_blend = y > -0.5 ? std::log1p(y) : std::log((1 - w) + w * end_);
    return a_ * std::exp((x_ > 0 ? x_ + log_blend : log_blend) / p_);
  }

 private:
  double a_, b_, p_;
  bool regular_ = false;
  double l_ = 0, x_ = 0, blend_ = 0, end_ = 0;
};

}  // namespace keyline::numeric
