#pragma once

#include <cmath>

#include "keyline/core/point.h"

namespace keyline::core {

/// The largest coordinate that is taken from a file or a request, in either direction: products of
/// three such numbers are finite.
inline constexpr double kLargestCoordinate = 1e100;

/// True for a finite number beyond that. (What is not finite is refused, or left out, for itself.)
inline bool is_too_large(double coordinate) {
  return std::isfinite(coordinate) && std::abs(coordinate) > kLargestCoordinate;
}
inline bool is_too_large(Point3 p) {
  return is_too_large(p.x) || is_too_large(p.y) || is_too_large(p.z);
}

}  // namespace keyline::core
