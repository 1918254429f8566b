#pragma once

#include <optional>
#include <span>

#include "keyline/curve/bezier.h"

namespace keyline::lac {

/// A straight line through a logarithmic graph, by least squares.
struct GraphLine {
  double slope = 0;
  double variance = 0;  ///< mean square of the vertical residuals
};

/// Logarithmic curvature and torsion graphs of any curve in space given as Béziers end to end:
/// log rho against log |rho ds/drho|, rho the radius of curvature or of torsion ([QLAC] 5 for the
/// plane, 6 for space). From the Béziers' own derivatives at 32 places of each; places where the
/// radius is infinite or does not change are left out. Empty where fewer than 8 are left, or where
/// log rho changes by less than 1e-6.
struct GraphLines {
  std::optional<GraphLine> curvature;
  std::optional<GraphLine> torsion;
};
GraphLines graph_lines(std::span<const curve::Bezier3> pieces);

}  // namespace keyline::lac
