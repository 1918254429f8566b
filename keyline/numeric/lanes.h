#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <xsimd/xsimd.hpp>

/// What kernels on several doubles at once are written with: xsimd's batches, and one double in
/// their place where a processor has no instructions that xsimd knows. Kernels call fma, select, …
/// without naming a namespace; the argument's own is found.
namespace keyline::numeric::simd {

/// The instruction set that has none: one lane, plain doubles.
struct ScalarArch {};

struct ScalarMask {
  bool on = false;
  ScalarMask() = default;
  explicit ScalarMask(bool value) : on(value) {}
  friend ScalarMask operator&(ScalarMask a, ScalarMask b) { return ScalarMask(a.on && b.on); }
  friend ScalarMask operator|(ScalarMask a, ScalarMask b) { return ScalarMask(a.on || b.on); }
  friend ScalarMask operator!(ScalarMask a) { return ScalarMask(!a.on); }
  friend bool any(ScalarMask mask) { return mask.on; }
};

/// A batch of one, with the members and functions of xsimd::batch that the kernels use.
struct Scalar {
  using arch_type = ScalarArch;
  using batch_bool_type = ScalarMask;
  static constexpr std::size_t size = 1;

  double value = 0;

  Scalar() = default;
  explicit Scalar(double v) : value(v) {}
  static Scalar load_aligned(const double* from) { return Scalar(*from); }
  void store_aligned(double* to) const { *to = value; }
  double get(std::size_t) const { return value; }

  Scalar& operator+=(Scalar b) { return value += b.value, *this; }
  friend Scalar operator+(Scalar a, Scalar b) { return Scalar(a.value + b.value); }
  friend Scalar operator-(Scalar a, Scalar b) { return Scalar(a.value - b.value); }
  friend Scalar operator*(Scalar a, Scalar b) { return Scalar(a.value * b.value); }
  friend Scalar operator/(Scalar a, Scalar b) { return Scalar(a.value / b.value); }
  friend Scalar operator-(Scalar a) { return Scalar(-a.value); }
  friend ScalarMask operator<(Scalar a, Scalar b) { return ScalarMask(a.value < b.value); }
  friend ScalarMask operator>(Scalar a, Scalar b) { return ScalarMask(a.value > b.value); }
  friend ScalarMask operator==(Scalar a, Scalar b) { return ScalarMask(a.value == b.value); }

  /// Two roundings: std::fma is a slow call where the processor has none, and xsimd does the same.
  friend Scalar fma(Scalar a, Scalar b, Scalar c) { return Scalar(a.value * b.value + c.value); }
  friend Scalar fnma(Scalar a, Scalar b, Scalar c) { return Scalar(c.value - a.value * b.value); }
  friend Scalar select(ScalarMask where, Scalar yes, Scalar no) { return where.on ? yes : no; }
  friend double hadd(Scalar a) { return a.value; }
  friend Scalar abs(Scalar a) { return Scalar(std::abs(a.value)); }
  friend Scalar min(Scalar a, Scalar b) { return Scalar(std::min(a.value, b.value)); }
  friend Scalar max(Scalar a, Scalar b) { return Scalar(std::max(a.value, b.value)); }
  friend Scalar sqrt(Scalar a) { return Scalar(std::sqrt(a.value)); }
  friend Scalar log(Scalar a) { return Scalar(std::log(a.value)); }
  friend Scalar atan2(Scalar y, Scalar x) { return Scalar(std::atan2(y.value, x.value)); }
};

namespace detail {
template <class Arch>
struct LanesOf {
  using type = xsimd::batch<double, Arch>;
};
template <>
struct LanesOf<ScalarArch> {
  using type = Scalar;
};
}  // namespace detail

/// The batch of doubles of an instruction set.
template <class Arch>
using Lanes = typename detail::LanesOf<Arch>::type;

/// The widest set that every processor of this build has.
using BaselineArch = std::conditional_t<std::is_same_v<xsimd::default_arch, xsimd::unavailable>,
                                        ScalarArch, xsimd::default_arch>;

/// The doubles' bits, moved 52 places up: 2^n from n + 1023 in the lowest ones.
inline Scalar bits_to_exponent(Scalar x) {
  return Scalar(std::bit_cast<double>(std::bit_cast<std::uint64_t>(x.value) << 52));
}
#ifndef XSIMD_NO_SUPPORTED_ARCHITECTURE
template <class Arch>
inline xsimd::batch<double, Arch> bits_to_exponent(const xsimd::batch<double, Arch>& x) {
  using Integers = xsimd::batch<std::int64_t, Arch>;
  return xsimd::bitwise_cast<xsimd::batch<double, Arch>>(xsimd::bitwise_cast<Integers>(x) << 52);
}
#endif

}  // namespace keyline::numeric::simd
