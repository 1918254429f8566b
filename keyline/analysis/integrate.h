#pragma once

#include <algorithm>
#include <vector>

#include "keyline/core/interval.h"
#include "keyline/numeric/quadrature.h"

namespace keyline::analysis::detail {

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
  for (std::size_t i = 1; i < ends.size(); ++i)
    sum += numeric::integrate_gauss<8>(f, ends[i - 1], ends[i]);
  return sum;
}

}  // namespace keyline::analysis::detail
