#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/lac/hermite/chord_kernel.h"

/// Internals: the bracketed Newton search for a chord angle, shared by the segment and the compound
/// solver (docs/design/g1-solver.md).
namespace keyline::lac::detail {

/// The chord at one value of the unknown range q.
struct ChordSample {
  double q = 0;
  double miss = 0;    ///< chord angle reached less the one wanted; grows with q
  double slope = 0;   ///< d(miss)/dq
  double length = 1;  ///< of the chord, for unit arc length
  double length_slope = 0;
};

struct SearchSetup {
  double guess = 1;
  double k = 1;                    ///< the chord angle is close to linear in e^{-kq} near its limit
  double sharpness = 1;            ///< bound of the relative second derivatives by q
  double largest = kLargestRange;  ///< q beyond it is not representable
  bool limit_drawn = false;        ///< q = infinity is a curve (ends in an inflection or a cusp)
  bool inside = false;             ///< where it is not: whether the wanted angle is below the limit
};

/// True where e^{-kq} vanishes against 1 before q reaches its largest value.
inline bool is_resolved(const SearchSetup& setup) { return setup.k * setup.largest > 40; }

/// Secant between a sample short of the root and one beyond it, in e^{-kq} or, for small k, in
/// 1/(1+q).
inline double secant(const SearchSetup& setup, const ChordSample& s, const ChordSample& beyond) {
  const double share = -s.miss / (beyond.miss - s.miss);
  if (is_resolved(setup)) {
    const double lost = std::isinf(beyond.q) ? 1 : -std::expm1(-setup.k * (beyond.q - s.q));
    return s.q - std::log1p(-share * lost) / setup.k;
  }
  const double from = 1 / (1 + s.q);
  const double to = 1 / (1 + beyond.q);
  return 1 / (from + share * (to - from)) - 1;
}

/// The miss, times the chord's length, up to which the limit is the curve wanted: rounding of the
/// handles of a curve that ends in an inflection or a cusp puts their chord as far outside.
inline constexpr double kAtLimit = 2e-15;

/// What the limit says to a chord angle that no q tried so far has reached; `limit` is the sample
/// at the end of the range.
template <class F>
ChordStatus verdict_at_limit(const SearchSetup& setup, F&& at, ChordSample& limit) {
  const double infinity = std::numeric_limits<double>::infinity();
  const bool resolved = setup.limit_drawn && is_resolved(setup);
  limit = at(resolved ? infinity : setup.largest);
  if (limit.miss > 0) return ChordStatus::solved;
  if (!setup.limit_drawn) {
    return setup.inside ? ChordStatus::beyond_precision : ChordStatus::beyond_region;
  }
  const ChordSample end = resolved ? limit : at(infinity);
  if (std::abs(end.miss) * end.length < kAtLimit) {
    limit = end;
    return ChordStatus::solved;
  }
  return end.miss > 0 ? ChordStatus::beyond_precision : ChordStatus::beyond_region;
}

/// Newton's step in e^{-kq}; infinite where it leads past the limit.
inline double newton_step(const SearchSetup& setup, const ChordSample& s) {
  const double x = setup.k * s.miss / s.slope;
  if (!(s.slope > 0) || !(x > -1)) {
    const double infinity = std::numeric_limits<double>::infinity();
    return s.miss < 0 ? infinity : -infinity;
  }
  return std::abs(x) < 1e-300 ? -s.miss / s.slope : -std::log1p(x) / setup.k;
}

/// Halves the bracket, or its logarithm where it spans orders of magnitude.
inline double middle_of(double low, double high) {
  if (high > 1000 * (1 + low)) return std::sqrt((1 + low) * (1 + high)) - 1;
  return (low + high) / 2;
}

/// The q > 0 with at(q).miss = 0, where at(0).miss < 0.
template <class F>
ChordSolution search_chord(const SearchSetup& setup, F&& at) {
  double low = 0;
  double high = std::numeric_limits<double>::infinity();
  double q = std::min(setup.guess, setup.largest);
  ChordSample s;
  int iteration = 1;
  for (; iteration <= 100; ++iteration) {
    s = at(q);
    const double change = newton_step(setup, s);
    // A short chord, near a full turn, swings faster.
    if (s.miss == 0 || std::abs(s.miss * setup.sharpness * change) < 2e-16 * s.length * s.length) {
      const double next = std::clamp(s.miss == 0 ? q : q + change, 0.0, setup.largest);
      return {ChordStatus::solved, next, s.length + s.length_slope * (next - q), iteration};
    }
    (s.miss < 0 ? low : high) = q;
    double next = q + change;
    if (next > setup.largest && std::isinf(high)) {
      ChordSample limit;
      const ChordStatus verdict = verdict_at_limit(setup, at, limit);
      if (verdict != ChordStatus::solved) return {verdict, limit.q, 1, iteration};
      if (limit.miss < 4e-16) return {verdict, limit.q, limit.length, iteration};
      next = secant(setup, s, limit);
      if (next > setup.largest) return {verdict, limit.q, limit.length, iteration};
      high = limit.q;
    }
    if (std::isfinite(high) && high - low <= 4e-16 * high) break;
    const bool slow = iteration > 12 && iteration % 3 == 0 && std::isfinite(high);
    if (slow || !(next > low && next < high)) next = middle_of(low, std::min(high, setup.largest));
    q = next;
  }
  return {ChordStatus::solved, q, s.length, iteration};
}

}  // namespace keyline::lac::detail
