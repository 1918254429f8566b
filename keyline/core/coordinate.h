#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "keyline/core/error.h"
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

/// The failure of such a coordinate at that place of what was given.
inline std::unexpected<Failure> coordinate_too_large(std::string place) {
  return fail(ErrorCode::bad_input, "a coordinate is larger than 1e100",
              "check the unit, or divide all coordinates by a common factor", std::move(place));
}

}  // namespace keyline::core
