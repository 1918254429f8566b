#pragma once

/// Internals: where curvature is clamped that would leave the doubles
/// (docs/design/g1-solver.md, "Beyond the doubles").
namespace keyline::lac::detail {

/// Least |ln| of curvature times chord, or of the end curvatures' ratio, that is clamped: the
/// square of e^250 is still a double.
inline constexpr double kFar = 250;
/// Where it is then cut, curvature staying constant from there on: what is cut off is shorter, or
/// turns by less, than e^-100 = 4e-44 of the whole.
inline constexpr double kKept = 100;

}  // namespace keyline::lac::detail
