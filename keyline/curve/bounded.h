#pragma once

#include <cmath>

/// Internals of room curve: doubles that carry a bound of their own rounding error.
namespace keyline::curve::detail {

/// A number known to lie within `error` of `value`. Overflow gives an infinite or NaN bound, which
/// no sign survives.
struct Bounded {
  double value = 0;
  double error = 0;
  Bounded() = default;
  explicit Bounded(int v) : value(v) {}
  explicit Bounded(double v) : value(v) {}
  Bounded(double v, double e) : value(v), error(e) {}
};

/// Twice the unit roundoff, so that rounding of the bounds themselves is covered.
inline constexpr double kRounding = 0x1p-52;
inline constexpr double kInflation = 1 + 0x1p-50;

inline Bounded operator+(const Bounded& a, const Bounded& b) {
  const double v = a.value + b.value;
  return {v, (a.error + b.error + kRounding * std::abs(v)) * kInflation};
}
inline Bounded operator-(const Bounded& a, const Bounded& b) {
  const double v = a.value - b.value;
  return {v, (a.error + b.error + kRounding * std::abs(v)) * kInflation};
}
inline Bounded operator*(const Bounded& a, const Bounded& b) {
  const double v = a.value * b.value;
  double e = std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error;
  if (std::abs(v) < 1e-280 && a.value != 0 && b.value != 0) e += 1e-280;  // underflow
  return {v, (e + kRounding * std::abs(v)) * kInflation};
}
/// b is larger than its error.
inline Bounded operator/(const Bounded& a, const Bounded& b) {
  const double v = a.value / b.value;
  double e = (a.error + std::abs(v) * b.error) / (std::abs(b.value) - b.error);
  if (std::abs(v) < 1e-280 && a.value != 0) e += 1e-280;
  return {v, (e + kRounding * std::abs(v)) * kInflation};
}
inline Bounded half_sum(const Bounded& a, const Bounded& b) {
  const Bounded s = a + b;
  return {0.5 * s.value, 0.5 * s.error};
}

enum class Sign { negative = -1, zero = 0, positive = 1, unknown = 2 };

inline Sign sign_of(const Bounded& a) {
  if (a.value > a.error) return Sign::positive;
  if (a.value < -a.error) return Sign::negative;
  return a.value == 0 && a.error == 0 ? Sign::zero : Sign::unknown;
}

}  // namespace keyline::curve::detail
