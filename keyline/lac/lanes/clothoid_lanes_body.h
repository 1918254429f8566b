#pragma once

#include <array>

#include "keyline/numeric/elementary.h"

/// Internals: the clothoid between two points with given tangents, in closed form but for one
/// Newton step; on one double or a batch of them. Derived in docs/design/g1-solver.md, "Clothoids".
///
/// Included once for each instruction set by a source compiled for it.
namespace keyline::lac::detail {

/// The chord is the sum of y^k a_k i^k, a_k = j_k(h) / h^k (spherical Bessel functions): for
/// y <= h <= 1.58 what is left out is below 1e-17.
inline constexpr int kLastTerm = 17;

template <class Batch>
using ClothoidTerms = std::array<Batch, kLastTerm + 2>;

/// Coefficients of a_k by h^2: (-1/2)^n / (n! (2k + 2n + 1)!!).
constexpr std::array<double, 9> clothoid_series(int k) {
  std::array<double, 9> series{};
  double c = 1;
  for (int i = 3; i <= 2 * k + 1; i += 2) c /= i;
  for (int n = 0; n < 9; ++n) {
    series[n] = c;
    c *= -0.5 / ((n + 1) * (2 * (k + n) + 3));
  }
  return series;
}

template <class Batch>
inline Batch clothoid_term(const Batch& z, const std::array<double, 9>& series) {
  Batch sum(series[8]);
  for (int n = 7; n >= 0; --n) sum = fma(sum, z, Batch(series[n]));
  return sum;
}

/// The last two by their series, the others by the recurrence downwards, in which they grow.
template <class Batch>
inline void clothoid_terms(const Batch& z, ClothoidTerms<Batch>& a) {
  constexpr std::array<double, 9> kLast = clothoid_series(kLastTerm);
  constexpr std::array<double, 9> kBeyond = clothoid_series(kLastTerm + 1);
  a[kLastTerm + 1] = clothoid_term(z, kBeyond);
  a[kLastTerm] = clothoid_term(z, kLast);
  for (int k = kLastTerm; k > 0; --k) a[k - 1] = fnma(z, a[k + 1], Batch(2.0 * k + 1) * a[k]);
}

/// y at the chord angle `excess`: its odd series by y, turned about to the fifth power. Within
/// 1e-7 of itself for y <= h <= 1.58.
template <class Batch>
inline Batch clothoid_guess(const ClothoidTerms<Batch>& a, const Batch& excess) {
  const Batch both = Batch(1.0) / (a[0] * a[1]);
  const Batch unit = a[1] * both;
  const Batch x = excess * a[0] * a[0] * both;
  // tan of the angle: t1 y + t3 y^3 + t5 y^5, over t1; then the angle itself.
  const Batch t1 = a[1] * unit;
  const Batch inverse = a[0] * both;
  const Batch c2 = a[2] * unit;
  const Batch t3 = fnma(a[3], inverse, c2);
  const Batch t5 = fma(a[5], inverse, fnma(a[4], unit, c2 * t3));
  const Batch square = t1 * t1;
  const Batch g3 = fnma(square, Batch(1.0 / 3), t3);
  const Batch g5 = fma(square, Batch(0.2) * square - t3, t5);
  const Batch x2 = x * x;
  return x * fma(x2, fma(x2, Batch(3.0) * g3 * g3 - g5, -g3), Batch(1.0));
}

/// For unit length: curvatures 2 (h + y) and 2 (h - y) at the heavy and the light end.
template <class Batch>
struct ClothoidLanes {
  Batch y = Batch(0.0);
  Batch chord_length = Batch(1.0);
  typename Batch::batch_bool_type solved{};
};

/// The chord, and its derivative by y.
template <class Batch>
struct ClothoidChord {
  Batch x, y, x_slope, y_slope;
  ClothoidChord(const ClothoidTerms<Batch>& a, const Batch& at) {
    const Batch w = at * at;
    x = a[kLastTerm - 1];
    y = a[kLastTerm];
    for (int k = kLastTerm - 3; k >= 0; k -= 2) {
      x = fnma(w, x, a[k]);
      y = fnma(w, y, a[k + 1]);
    }
    y = y * at;
    x_slope = Batch(12.0) * a[12];
    y_slope = Batch(13.0) * a[13];
    for (int k = 10; k >= 2; k -= 2) {
      x_slope = fnma(w, x_slope, Batch(1.0 * k) * a[k]);
      y_slope = fnma(w, y_slope, Batch(k + 1.0) * a[k + 1]);
    }
    x_slope = -(x_slope * at);
    y_slope = fnma(w, y_slope, a[1]);
  }
};

/// The clothoid turning by 2 h whose chord lies `excess` beyond the middle direction, seen in the
/// direction in which curvature falls: 0 <= excess < h. Not solved: h above 1.58 or the light end
/// within 1e-5 of an inflection, or beyond it.
template <class Batch>
inline ClothoidLanes<Batch> clothoid_lanes(const Batch& h, const Batch& excess) {
  ClothoidTerms<Batch> a;
  clothoid_terms(h * h, a);
  const Batch guess = clothoid_guess(a, excess);
  const ClothoidChord<Batch> chord(a, guess);
  Batch sine, cosine;
  numeric::simd::sincos_short(excess, sine, cosine);
  const Batch square = chord.x * chord.x + chord.y * chord.y;
  const Batch across = chord.y * cosine - chord.x * sine;
  const Batch along = chord.x * cosine + chord.y * sine;
  const Batch rate = chord.x * chord.y_slope - chord.y * chord.x_slope;
  const Batch change = -(across * square) / (along * rate);
  const Batch length = sqrt(square);
  ClothoidLanes<Batch> answer;
  answer.y = guess + change;
  answer.chord_length =
      length + change * (chord.x * chord.x_slope + chord.y * chord.y_slope) / length;
  // Newton's step leaves less than the square of what it changes.
  answer.solved =
      (h < Batch(1.58)) & (answer.y < Batch(1 - 1e-5) * h) & (abs(change) < Batch(1e-6) * guess);
  return answer;
}

}  // namespace keyline::lac::detail
