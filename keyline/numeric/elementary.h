#pragma once

#include "keyline/numeric/lanes.h"

/// Elementary functions on batches of doubles (lanes.h), for kernels compiled once per instruction
/// set and chosen at run time (instruction_set.h). Leaner than the general ones: no special values,
/// short ranges, as stated; within them the error stays below 2e-16 of the result unless said
/// otherwise. Everything here is a template on the batch, so that no code for one instruction set
/// can be linked in place of another's. Polynomials are Taylor sums, cut where the rest is below
/// 5e-17.
namespace keyline::numeric::simd {

/// c0 + x (c1 + x (…)), compile-time length.
template <class Batch>
inline Batch horner(const Batch&, double last) {
  return Batch(last);
}
template <class Batch, class... Rest>
inline Batch horner(const Batch& x, double first, Rest... rest) {
  return fma(x, horner(x, rest...), Batch(first));
}

/// x = n ln 2 + r, |r| <= ln(2) / 2; gives 2^n and e^r - 1.
template <class Batch>
inline void reduce_exponential(const Batch& x, Batch& power, Batch& rest) {
  const Batch shift(6755399441055744.0 + 1023);  // 1.5 * 2^52: rounds, and leaves n + 1023 below
  const Batch biased = fma(x, Batch(1.4426950408889634074), shift);
  const Batch n = biased - shift;
  const Batch high = fnma(n, Batch(0x1.62e42fefa0000p-1), x);
  const Batch r = fnma(n, Batch(0x1.cf79abc9e3b3ap-40), high);
  const Batch r2 = r * r;
  const Batch r4 = r2 * r2;
  const Batch low = fma(r2, horner(r, 1.0 / 24, 1.0 / 120), horner(r, 1.0 / 2, 1.0 / 6));
  const Batch top =
      fma(r4, horner(r, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600),
          fma(r2, horner(r, 1.0 / 40320, 1.0 / 362880), horner(r, 1.0 / 720, 1.0 / 5040)));
  rest = fma(r2, fma(r4, top, low), r);
  power = bits_to_exponent(biased);
}

/// e^x for -700 <= x <= 700.
template <class Batch>
inline Batch exp(const Batch& x) {
  Batch power, rest;
  reduce_exponential(x, power, rest);
  return fma(power, rest, power);
}

/// e^x - 1 for -700 <= x <= 700, error 5e-16 of the result, near 0 as well.
template <class Batch>
inline Batch expm1(const Batch& x) {
  Batch power, rest;
  reduce_exponential(x, power, rest);
  return fma(power, rest, power - Batch(1.0));
}

/// Sine and cosine of x for |x| <= 1.7, absolute error 6e-16: by the half angle.
template <class Batch>
inline void sincos_short(const Batch& x, Batch& sine, Batch& cosine) {
  const Batch h = Batch(0.5) * x;
  const Batch z = h * h;
  const Batch z2 = z * z;
  const Batch z4 = z2 * z2;
  const Batch s0 = fma(z2, horner(z, 1.0 / 120, -1.0 / 5040), horner(z, 1.0, -1.0 / 6));
  const Batch s1 = fma(z2, horner(z, 1.0 / 6227020800.0, -1.0 / 1307674368000.0),
                       horner(z, 1.0 / 362880, -1.0 / 39916800));
  const Batch c0 = fma(z2, horner(z, 1.0 / 24, -1.0 / 720), horner(z, 1.0, -1.0 / 2));
  const Batch c1 = fma(z2, horner(z, 1.0 / 479001600, -1.0 / 87178291200.0, 1.0 / 20922789888000.0),
                       horner(z, 1.0 / 40320, -1.0 / 3628800));
  const Batch s = h * fma(z4, s1, s0);
  const Batch c = fma(z4, c1, c0);
  const Batch twice = s + s;
  sine = twice * c;
  cosine = fnma(twice, s, Batch(1));
}

}  // namespace keyline::numeric::simd
