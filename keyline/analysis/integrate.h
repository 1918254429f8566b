#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "keyline/core/interval.h"

namespace keyline::analysis::detail {

/// Eight-point Gauss–Legendre rule on [a, b].
template <class F>
double gauss8(const F& f, double a, double b) {
  constexpr std::array<double, 4> nodes = {0.18343464249564980494, 0.52553240991632898582,
                                           0.79666647741362673959, 0.96028985649753623168};
  constexpr std::array<double, 4> weights = {0.36268378337836198297, 0.31370664587788728734,
                                             0.22238103445337447054, 0.10122853629037625915};
  const double middle = (a + b) / 2;
  const double half = (b - a) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double d = half * nodes[i];
    sum += weights[i] * (f(middle - d) + f(middle + d));
  }
  return half * sum;
}

/// The interval cut at the breakpoints inside it, each stretch into equal parts: about `parts`
/// of them in all, and at least `least` in every stretch.
inline std::vector<double> panel_ends(const std::vector<double>& breakpoints, core::Interval t,
                                      int parts, int least = 1) {
  std::vector<double> cuts = {t.low};
  for (double b : breakpoints) {
    if (b > t.low && b < t.high) cuts.push_back(b);
  }
  cuts.push_back(t.high);
  const int stretches = static_cast<int>(cuts.size()) - 1;
  const int each = std::max(least, (parts + stretches - 1) / stretches);
  std::vector<double> ends = {t.low};
  for (int i = 0; i < stretches; ++i) {
    for (int k = 1; k < each; ++k) {
      const double u = static_cast<double>(k) / each;
      ends.push_back((1 - u) * cuts[i] + u * cuts[i + 1]);
    }
    ends.push_back(cuts[i + 1]);
  }
  return ends;
}

/// Integral of f over the panels.
template <class F>
double integrate(const F& f, const std::vector<double>& ends) {
  double sum = 0;
  for (std::size_t i = 1; i < ends.size(); ++i) sum += gauss8(f, ends[i - 1], ends[i]);
  return sum;
}

}  // namespace keyline::analysis::detail
