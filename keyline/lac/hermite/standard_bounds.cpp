#include "keyline/lac/hermite/standard_bounds.h"

#include <cmath>

namespace keyline::lac {
namespace {

/// Below the normal doubles a bound is as good as none.
std::optional<double> finite(double bound) {
  return std::isfinite(bound) ? std::optional(bound) : std::nullopt;
}

}  // namespace

StandardBounds standard_bounds(double alpha, double lambda) {
  StandardBounds b;
  if (alpha < 0) b.s_high = finite(-1 / (lambda * alpha));
  if (alpha > 0) b.s_low = finite(-1 / (lambda * alpha));
  if (alpha < 1) b.theta_high = finite(1 / (lambda * (1 - alpha)));
  if (alpha > 1) b.theta_low = finite(1 / (lambda * (1 - alpha)));
  return b;
}

}  // namespace keyline::lac
