#pragma once

#include <algorithm>
#include <cmath>

namespace keyline::core {

/// Absolute tolerance in the unit of the quantity, relative as a fraction of its size.
struct Tolerance {
  double absolute = 0;
  double relative = 0;
};

/// True where a and b differ by no more than the larger of the two tolerances.
inline bool is_close(double a, double b, const Tolerance& tolerance) {
  const double size = std::max(std::abs(a), std::abs(b));
  return std::abs(a - b) <= std::max(tolerance.absolute, tolerance.relative * size);
}

}  // namespace keyline::core
