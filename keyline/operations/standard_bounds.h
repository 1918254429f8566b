#pragma once

#include <array>
#include <optional>

#include "keyline/core/describe.h"
#include "keyline/lac/hermite/standard_bounds.h"

namespace keyline::operations {

/// [Compound] Tab. 1 in results: null where the curve has no end.
struct BoundsShown {
  std::array<std::optional<double>, 2> s;
  std::array<std::optional<double>, 2> theta;
  static constexpr auto describe() {
    return core::fields(
        core::field<&BoundsShown::s>("arc length, in radii at the reference point; null: no end"),
        core::field<&BoundsShown::theta>("tangent angle; null: no end").in("radian"));
  }
};
inline BoundsShown bounds_shown(double alpha, double lambda) {
  const lac::StandardBounds b = lac::standard_bounds(alpha, lambda);
  return {{b.s_low, b.s_high}, {b.theta_low, b.theta_high}};
}

inline constexpr const char* kBounds =
    "where the standard form ends: rho runs from 0 to infinity between them";

}  // namespace keyline::operations
