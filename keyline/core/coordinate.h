#pragma once

#include <cmath>

namespace keyline::core {

/// The largest coordinate that is taken from a file or a request, in either direction: products of
/// three such numbers are finite.
inline constexpr double kLargestCoordinate = 1e100;

/// True for a finite number beyond that. (What is not finite is refused, or left out, for itself.)
inline bool is_too_large(double coordinate) {
  return std::isfinite(coordinate) && std::abs(coordinate) > kLargestCoordinate;
}

}  // namespace keyline::core
