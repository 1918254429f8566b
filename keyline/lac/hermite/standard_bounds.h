#pragma once

#include <optional>

namespace keyline::lac {

/// Where a curve of the standard form ends, an empty side being open: arc length s and tangent
/// angle theta from the reference point, in units of its radius of curvature, both growing with the
/// radius ([Compound] Tab. 1).
struct StandardBounds {
  std::optional<double> s_low, s_high;
  std::optional<double> theta_low, theta_high;
};

/// rho runs from 0 to infinity over them. None for lambda = 0, a circle. alpha is finite, lambda is
/// drho/ds at the reference point, 0 or more.
StandardBounds standard_bounds(double alpha, double lambda);

}  // namespace keyline::lac
