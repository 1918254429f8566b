#pragma once

namespace keyline::curve {

/// A control edge shorter than this share of the longest counts as none: rounding of the points
/// takes its direction.
inline constexpr double kLeastEdge = 1e-12;

}  // namespace keyline::curve
