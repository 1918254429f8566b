#pragma once

#include <array>
#include <cstddef>

namespace keyline::own {

/// Integral of f over [from, to] by Gauss and Legendre's rule with 10 nodes (Abramowitz & Stegun,
/// table 25.4).
template <class F>
auto gauss(const F& f, double from, double to) {
  constexpr std::array<double, 5> kNodes{0.148874338981631211, 0.433395394129247191,
                                         0.679409568299024406, 0.865063366688984511,
                                         0.973906528517171720};
  constexpr std::array<double, 5> kWeights{0.295524224714752870, 0.269266719309996355,
                                           0.219086362515982044, 0.149451349150580593,
                                           0.066671344308688138};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  decltype(f(middle)) sum{};
  for (std::size_t i = 0; i < kNodes.size(); ++i)
    sum += kWeights[i] * (f(middle - half * kNodes[i]) + f(middle + half * kNodes[i]));
  return half * sum;
}

}  // namespace keyline::own
