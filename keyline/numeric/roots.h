#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include <boost/math/tools/toms748_solve.hpp>

namespace keyline::numeric {

/// A zero of continuous f in [low, high], where f changes sign between the ends, within an
/// absolute error of tolerance (never finer than the spacing of doubles). Alefeld, Potra and Shi's
/// algorithm 748, at most 200 evaluations.
/// Returns: empty if f has one sign at both ends, an end gives NaN, or not low < high.
template <class F>
std::optional<double> bracketed_root(F&& f, double low, double high, double tolerance) {
  if (!(low < high)) return std::nullopt;  // panels next to a breakpoint may be of no width
  const double at_low = f(low);
  const double at_high = f(high);
  if (at_low == 0) return low;
  if (at_high == 0) return high;
  if (!(at_low * (at_high > 0 ? 1.0 : -1.0) < 0) || std::isnan(at_high)) return std::nullopt;
  const auto narrow = [tolerance](double a, double b) {
    const double spacing = 9e-16 * std::fmax(std::abs(a), std::abs(b));
    return std::abs(b - a) <= std::fmax(2 * tolerance, spacing);
  };
  std::uintmax_t evaluations = 200;
  const auto [a, b] =
      boost::math::tools::toms748_solve(f, low, high, at_low, at_high, narrow, evaluations);
  return std::abs(f(a)) < std::abs(f(b)) ? a : b;
}

}  // namespace keyline::numeric
