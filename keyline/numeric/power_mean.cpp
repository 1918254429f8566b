#include "keyline/numeric/power_mean.h"

#include <algorithm>

namespace keyline::numeric {
namespace {

/// ln((e^x - 1) / x).
double log_expm1_over(double x) {
  if (x > 40) return x - std::log(x);
  if (x < -40) return -std::log(-x);
  return std::log(expm1_over(x));
}

/// Integral of M_p(1, e^l; .) over [0, u]. With l(v) = ln M_p and v = expm1(p l) / expm1(x):
/// u E((1+p) l) / E(p l), E(x) = (e^x - 1) / x, every limit of which is E(0) = 1.
double unit_integral(double l, double p, double u) {
  const double m = detail::log_power_mean(l, p, u);
  const double top = (1 + p) * m;
  const double bottom = p * m;
  if (std::max(std::abs(top), std::abs(bottom)) < 300) {
    return u * expm1_over(top) / expm1_over(bottom);
  }
  return u * std::exp(log_expm1_over(top) - log_expm1_over(bottom));
}

/// Integral over [0, u] of w^e with w = v, or w = 1 - v where the growing end is the first.
double pure_power_integral(double e, double u, bool falling) {
  if (!(e > -1)) return std::numeric_limits<double>::infinity();
  if (!falling) return std::pow(u, e + 1) / (e + 1);
  return -std::expm1((e + 1) * std::log1p(-u)) / (e + 1);
}

}  // namespace

double power_mean_integral(double a, double b, double p, double u) {
  if (u <= 0) return 0;
  if (a == b) return u * a;
  const bool infinite = std::isinf(a) || std::isinf(b);
  if (a > 0 && b > 0 && !infinite) return a * unit_integral(log_ratio(a, b), p, std::min(u, 1.0));
  if (p != 0 && infinite == (p < 0)) {
    const bool falling = infinite ? std::isinf(a) : a > 0;
    const double kept = infinite ? (std::isinf(a) ? b : a) : std::max(a, b);
    // The kept end carries the weight: M = kept * weight^(1/p), weight = 1 - v if it is a.
    const bool kept_first = infinite ? !falling : falling;
    return kept * pure_power_integral(1 / p, std::min(u, 1.0), kept_first);
  }
  return infinite ? std::numeric_limits<double>::infinity() : 0.0;
}

double signed_power_mean_integral(double a, double b, double p, double u) {
  if (a >= 0 && b >= 0) return power_mean_integral(a, b, p, u);
  if (a <= 0 && b <= 0) return -power_mean_integral(-a, -b, p, u);
  const double size = std::max(std::abs(a), std::abs(b));
  const double first = a / size, last = b / size;
  const double from = signed_power(first, p);
  const double to = signed_power(last, p);
  const double g = (1 - u) * from + u * to;
  const double e = 1 + 1 / p;
  // The root of a small p would magnify the rounding of the powers by 1 / p: the mean at u is seen
  // from the end of its sign. Rounding may see zero from a hair beyond it; a power that is lost to
  // underflow is 0 and asked for nothing.
  const auto seen_from = [&](double end, double power, double step) {
    return power == 0 ? 0 : end * std::exp(std::log1p(std::max(-1.0, step / power)) / p);
  };
  const double mean = std::signbit(g) == std::signbit(from)
                          ? seen_from(first, from, u * (to - from))
                          : seen_from(last, to, (1 - u) * (from - to));
  return size * (g * mean - from * first) / (e * (to - from));
}

}  // namespace keyline::numeric
