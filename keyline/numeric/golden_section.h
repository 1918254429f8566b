#pragma once

#include <numbers>
#include <utility>

namespace keyline::numeric {

/// Where f is least in [low, high], if it falls up to there and rises behind; within the tolerance,
/// but where f varies by no more than rounding (some 1e-8 of the size of a smooth f's argument).
/// With several such places it is one of them. Values of f need only be ordered by <; of equal ones
/// the right part is kept.
///
/// Method: golden section, one value of f a step.
template <class F>
double golden_section(F&& f, double low, double high, double tolerance) {
  constexpr double kShare = std::numbers::phi - 1;
  double left = high - kShare * (high - low);
  double right = low + kShare * (high - low);
  auto at_left = f(left);
  auto at_right = f(right);
  while (high - low > tolerance) {
    if (at_left < at_right) {
      high = std::exchange(right, left);
      at_right = std::move(at_left);
      left = high - kShare * (high - low);
      at_left = f(left);
    } else {
      low = std::exchange(left, right);
      at_left = std::move(at_right);
      right = low + kShare * (high - low);
      at_right = f(right);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace keyline::numeric
