#pragma once

#include <cmath>

namespace keyline::lac {

/// Formulas square the slope; beyond this they would overflow. Long before, at about 1e16, a
/// segment is an arc with a corner to double precision.
inline constexpr double kLargestSlope = 1e100;

/// False for NaN too.
inline bool is_slope(double alpha) { return std::abs(alpha) <= kLargestSlope; }

/// For failures of what is not.
inline constexpr const char* kSlopeRule = "the slope alpha must lie between -1e100 and 1e100";

}  // namespace keyline::lac
