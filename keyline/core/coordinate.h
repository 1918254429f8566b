#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "keyline/core/error.h"
#include "keyline/core/extent.h"
#include "keyline/core/point.h"

namespace keyline::core {

/// The largest coordinate that is taken from a file or a request, in either direction: products of
/// three such numbers are finite.
inline constexpr double kLargestCoordinate = 1e100;

/// True for a finite number beyond that. (What is not finite is refused, or left out, for itself.)
inline bool is_too_large(double coordinate) {
  return std::isfinite(coordinate) && std::abs(coordinate) > kLargestCoordinate;
}
inline bool is_too_large(Point2 p) { return is_too_large(p.x) || is_too_large(p.y); }
inline bool is_too_large(Point3 p) {
  return is_too_large(p.x) || is_too_large(p.y) || is_too_large(p.z);
}

/// A number that was read: 0 in place of what doubles hold with fewer digits (below 2.2e-308), as
/// neither products nor ratios of it say anything.
inline double with_all_digits(double number) {
  return std::fpclassify(number) == FP_SUBNORMAL ? 0 : number;
}

/// The smallest size that is measured: products of three such lengths are not 0.
inline constexpr double kSmallestSize = 1e-100;

/// True where the points are not all one and lie within less than that of each other.
template <class Points>
bool is_too_small(const Points& points) {
  const double size = reach(points);
  return size > 0 && size < kSmallestSize;
}

/// The failure of points like that, and that of a coordinate that is too large,
/// at that place of what was given.
inline std::unexpected<Failure> size_too_small(std::string place) {
  return fail(ErrorCode::bad_input, "the points lie within 1e-100 of each other",
              "check the unit, or multiply all coordinates by a common factor", std::move(place));
}
inline std::unexpected<Failure> coordinate_too_large(std::string place) {
  return fail(ErrorCode::bad_input, "a coordinate is larger than 1e100",
              "check the unit, or divide all coordinates by a common factor", std::move(place));
}

}  // namespace keyline::core
