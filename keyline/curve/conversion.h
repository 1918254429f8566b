#pragma once

#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/piecewise_bezier.h"
#include "keyline/curve/polyline.h"
#include "keyline/curve/view.h"

namespace keyline::curve {

/// The curve as cubic Béziers within `tolerance` (> 0, absolute; InvalidInput otherwise).
///
/// Every piece ends on the curve, tangent to it (G1 where the curve is; corners, where the tangent
/// turns by more than 1e-7 rad at a breakpoint, and jumps become ends of pieces). Pieces are as
/// long as the tolerance allows, one after the other, which gives the fewest of this kind; a
/// cubic comes back as itself.
///
/// Deviation bound (largest distance, both ways): first the curve is replaced by short cubics with
/// its own end points and derivatives, then each output piece is bounded against these rigorously
/// (detail::deviation_bound). The first step's error is bounded rigorously too for Bézier, B-spline
/// and polyline (Bernstein coefficients of the difference); for other curves it is one and a half
/// times the largest difference at five places of every short cubic, which are made so short that
/// it stays below 2 % of the tolerance.
PiecewiseBezier approximate_by_cubics(const Bezier2& c, double tolerance);
PiecewiseBezier approximate_by_cubics(const BSpline2& c, double tolerance);
PiecewiseBezier approximate_by_cubics(const Polyline2& c, double tolerance);
PiecewiseBezier approximate_by_cubics(const PlanarView& c, double tolerance);
template <PlanarCurve C>
PiecewiseBezier approximate_by_cubics(const C& c, double tolerance) {
  return approximate_by_cubics(PlanarView(c), tolerance);
}

/// A path of Béziers as one B-spline, every joint a knot of multiplicity `degree` (the highest
/// degree among them), knot spans as long as the pieces' control polygons. Rational as soon as one
/// piece is. Fails with bad_input and path "pieces[i]" where piece i does not start within
/// `tolerance` of the end of the one before, and for an empty or invalid path.
template <class P>
core::Result<BSpline<P>> to_bspline(const std::vector<Bezier<P>>& path, double tolerance = 0);
/// The polyline as a B-spline of degree 1, knots by length (repeated points dropped).
template <class P>
core::Result<BSpline<P>> to_bspline(const Polyline<P>& c);

}  // namespace keyline::curve
