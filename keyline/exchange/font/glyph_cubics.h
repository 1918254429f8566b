#pragma once

#include <vector>

#include "keyline/curve/bezier.h"
#include "keyline/document/planar_curve.h"

namespace keyline::exchange::detail {

struct GlyphCubics {
  std::vector<curve::Bezier2> pieces;  ///< degree 1 or 3
  double deviation = 0;
};

/// A curve as cubics with nodes at breakpoints where it turns, at extrema of x and y and at
/// inflections; see write_glif().
GlyphCubics glyph_cubics(const document::PlanarCurve& curve, double tolerance);

/// Largest distance of 33 places of a Bézier from a curve.
double measured_deviation(const curve::Bezier2& c, const document::PlanarCurve& exact);

}  // namespace keyline::exchange::detail
