#pragma once

#include <array>
#include <optional>

#include "keyline/lac/segment/segment.h"

/// Internals of the G2 Hermite solver: Newton's method on the end of a short chain.
namespace keyline::lac::detail {

/// End data for a chord of length 1 along x.
struct UnitG2 {
  double from = 0;  ///< direction at (0, 0)
  double to = 0;    ///< direction at (1, 0), the turning being to - from
  double curvature_start = 0;
  double curvature_end = 0;
  double alpha = -1;
  double longest = 24;  ///< a chain that becomes longer on the way counts as astray
};

/// Three unknowns decide a chain of two pieces (curvature at the joint, both lengths) or of three
/// (both joints' curvatures and the middle length; the outer lengths are `outer` times it).
struct ShortChain {
  int pieces = 2;
  double outer = 1;                   ///< of three pieces
  std::array<double, 4> curvature{};  ///< at the ends and joints, pieces + 1 of them
  std::array<double, 3> length{};     ///< of two pieces; of three only length[1] counts
  double length_of(int i) const { return pieces == 3 && i != 1 ? outer * length[1] : length[i]; }
};

/// Misses in x, y and direction.
using Miss = std::array<double, 3>;

/// From a start to a solution; empty where Newton's method, damped, does not get below 1e-12.
/// residual: the largest miss reached.
std::optional<ShortChain> shoot(const UnitG2& request, ShortChain start, double* residual);

}  // namespace keyline::lac::detail
