#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

/// Internals of space curves: variables in which curvature and torsion are smooth.
namespace keyline::lac::detail {

/// A part of a piece, 0 <= from < to <= 1, run through by s in [0, 1]. Next to a zero of curvature
/// or torsion these go as distance^(-1/slope), which is not smooth in t; in s, where the distance
/// is s^power, it is.
struct Stretch {
  double from = 0;
  double to = 1;
  double power = 1;
  bool zero_at_start = false;  ///< else at the end, if power is not 1

  double place(double s) const {
    if (s <= 0) return from;
    if (s >= 1) return to;
    if (zero_at_start) return from + (to - from) * std::pow(s, power);
    return power == 1 ? std::lerp(from, to, s) : to - (to - from) * std::pow(1 - s, power);
  }
  /// d(place)/ds.
  double rate(double s) const {
    if (power == 1) return to - from;
    return (to - from) * power * std::pow(zero_at_start ? s : 1 - s, power - 1);
  }
  double variable(double t) const {
    const double share = std::clamp((t - from) / (to - from), 0.0, 1.0);
    if (power == 1) return share;
    if (zero_at_start) return std::pow(share, 1 / power);
    return 1 - std::pow(std::clamp((to - t) / (to - from), 0.0, 1.0), 1 / power);
  }
};

/// Where a law of a slope below 0 is zero.
struct LawZero {
  double place = -1;  ///< outside [0, 1]: nowhere
  double slope = -1;
};

/// Power of the distance's variable: such that distance^(-1/slope) is an integer power of it and
/// the place itself is smooth at least to order 5; 1 where the law is smooth as it is.
inline double smoothing_power(double slope) {
  const double order = -1 / slope;
  if (std::abs(order - std::round(order)) < 1e-9 && order > 0.5) return 1;
  return std::ceil(5 / -slope) * -slope;
}

struct Stretches {
  int count = 0;
  std::array<Stretch, 6> all{};
  const Stretch* begin() const { return all.data(); }
  const Stretch* end() const { return all.data() + count; }
};

/// Adds [from, to] with the powers that its ends ask for, as two stretches where both ask.
inline void add_stretch(Stretches& s, double from, double to, double at_from, double at_to) {
  if (!(from < to)) return;
  if (at_from != 1 && at_to != 1) {
    const double middle = (from + to) / 2;
    s.all[s.count++] = {from, middle, at_from, true};
    s.all[s.count++] = {middle, to, at_to, false};
    return;
  }
  s.all[s.count++] = {from, to, at_from != 1 ? at_from : at_to, at_from != 1};
}

/// [0, 1] cut at the zeros.
inline Stretches stretches_between(LawZero a, LawZero b) {
  if (!(a.place <= b.place)) std::swap(a, b);
  const auto inside = [](const LawZero& z) { return z.place >= 0 && z.place <= 1; };
  Stretches s;
  double from = 0;
  double power = 1;
  for (const LawZero& zero : {a, b}) {
    if (!inside(zero)) continue;
    const double here = smoothing_power(zero.slope);
    if (zero.place > from) {
      add_stretch(s, from, zero.place, power, here);
      power = here;
    } else {
      power = std::max(power, here);
    }
    from = zero.place;
  }
  add_stretch(s, from, 1, power, 1);
  return s;
}

/// How a law runs along [0, 1]: as a power of the distance from a place, its zero or (slope above
/// 0) where it would be infinite; for a slope of 0 as an exponential.
struct LawRun {
  double place = HUGE_VAL;  ///< HUGE_VAL: nowhere
  double slope = -1;
  double growth = 0;  ///< ln of the end's value over the start's; counts for a slope of 0
};

/// Where to cut [0, 1] so that along a part neither the distance from the place grows by more than
/// 4 times nor the law by more than 8 times, as far as this is felt: 12 cuts on either side.
void add_cuts(const LawRun& law, std::vector<double>& cuts);

/// stretches_between with these cuts, for rules of few steps.
std::vector<Stretch> graded_stretches(const LawRun& a, const LawRun& b);

}  // namespace keyline::lac::detail
