#pragma once

#include <cmath>
#include <limits>

/// Weighted power means and their integrals: the one formula behind log-aesthetic curves.
/// With M_p(a, b; u) = ((1-u) a^p + u b^p)^(1/p) the curvature of a log-aesthetic curve of slope
/// alpha is M_{-alpha} in arc length, its radius of curvature M_{alpha-1} in tangent angle
/// ([Yoshida 2006]; [QLAC] Eqs. 2 and 4).
namespace keyline::numeric {

/// (e^x - 1) / x, continued by 1 at 0. Relative accuracy about 1e-16 for every x; +inf above 709.
inline double expm1_over(double x) { return x == 0 ? 1.0 : std::expm1(x) / x; }

/// sgn(x) |x|^e for e > 0: odd, increasing.
inline double signed_power(double x, double e) {
  return std::copysign(std::pow(std::abs(x), e), x);
}

/// ln(b / a) for a, b > 0, without loss where a is close to b.
inline double log_ratio(double a, double b) {
  const double r = b / a;
  if (r > 0.5 && r < 2) return std::log1p((b - a) / a);
  return r > 1e-300 && r < 1e300 ? std::log(r) : std::log(b) - std::log(a);
}

namespace detail {

/// ln((1-u) + u e^x) for u in [0, 1], without cancellation and without overflow.
inline double log_blend(double x, double u) {
  if (x > 0) return x + log_blend(-x, 1 - u);
  if (u >= 1) return x;
  const double y = u * std::expm1(x);
  return y > -0.5 ? std::log1p(y) : std::log((1 - u) + u * std::exp(x));
}

/// ln M_p(1, e^l; u).
inline double log_power_mean(double l, double p, double u) {
  const double x = p * l;
  return std::abs(x) < 1e-300 ? u * l : log_blend(x, u) / p;
}

}  // namespace detail

/// Weighted power mean M_p(a, b; u) of a, b >= 0 (0 and infinity allowed), u in [0, 1].
/// p = 0 is the geometric mean a^(1-u) b^u. Exact at u = 0 and u = 1; relative accuracy 1e-14,
/// no cancellation as p -> 0 or as b -> a; |p| may be 1e3 and more.
inline double power_mean(double a, double b, double p, double u) {
  if (u <= 0 || a == b) return a;
  if (u >= 1) return b;
  const bool infinite = std::isinf(a) || std::isinf(b);
  if (a > 0 && b > 0 && !infinite)
    return a * std::exp(detail::log_power_mean(log_ratio(a, b), p, u));
  if (infinite == (p < 0)) {  // one of the powers is zero: only the other end counts
    const double kept = infinite ? std::isinf(a) ? b : a : a > 0 ? a : b;
    const double weight = kept == a ? 1 - u : u;
    if (p != 0) return kept * std::pow(weight, 1 / p);
  }
  return infinite ? std::numeric_limits<double>::infinity() : 0.0;
}

/// The same with signed powers, p > 0: a and b may differ in sign, the mean crosses zero once.
inline double signed_power_mean(double a, double b, double p, double u) {
  if (a >= 0 && b >= 0) return power_mean(a, b, p, u);
  if (a <= 0 && b <= 0) return -power_mean(-a, -b, p, u);
  const double size = std::fmax(std::abs(a), std::abs(b));
  const double g = (1 - u) * signed_power(a / size, p) + u * signed_power(b / size, p);
  return size * signed_power(g, 1 / p);
}

/// Integral of M_p(a, b; .) over [0, u], a, b >= 0. At u = 1 this is Stolarsky's mean. The
/// logarithmic limits p -> 0 and p -> -1 are taken without loss, as is b -> a. An end may be 0
/// where p > 0 and infinite where p < -1 (there the integral is finite); else the true limit.
double power_mean_integral(double a, double b, double p, double u);

/// The same for signed powers, p > 0.
double signed_power_mean_integral(double a, double b, double p, double u);

}  // namespace keyline::numeric
