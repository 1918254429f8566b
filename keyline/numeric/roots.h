#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <boost/math/tools/toms748_solve.hpp>

namespace keyline::numeric {

/// A zero of continuous f in [low, high], where f changes sign between the ends, within an
/// absolute error of tolerance (never finer than the spacing of doubles). f is evaluated
/// within [low, high] only; infinite values count as large ones. Alefeld, Potra and Shi's algorithm
/// 748, at most 200 evaluations. Returns: empty if f has one sign at both ends, gives NaN anywhere,
/// or not low < high.
template <class F>
std::optional<double> bracketed_root(F&& f, double low, double high, double tolerance) {
  if (!(low < high)) return std::nullopt;  // panels next to a breakpoint may be of no width
  constexpr double kMost = 1e100;          // what interpolation makes of it stays finite
  bool defined = true;
  const auto finite = [&](double x) {
    const double value = f(x);
    if (!std::isnan(value)) return std::clamp(value, -kMost, kMost);
    defined = false;
    return 0.0;  // ends the search
  };
  const double at_low = finite(low);
  const double at_high = finite(high);
  if (!defined) return std::nullopt;
  if (at_low == 0) return low;
  if (at_high == 0) return high;
  if ((at_low > 0) == (at_high > 0)) return std::nullopt;
  const auto narrow = [tolerance](double a, double b) {
    const double spacing = 9e-16 * std::fmax(std::abs(a), std::abs(b));
    return std::abs(b - a) <= std::fmax(2 * tolerance, spacing);
  };
  std::uintmax_t evaluations = 200;
  const auto [a, b] =
      boost::math::tools::toms748_solve(finite, low, high, at_low, at_high, narrow, evaluations);
  const double nearer = std::abs(finite(a)) < std::abs(finite(b)) ? a : b;
  return defined ? std::optional(nearer) : std::nullopt;
}

}  // namespace keyline::numeric
