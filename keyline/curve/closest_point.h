#pragma once

#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/piecewise_bezier.h"
#include "keyline/curve/polyline.h"
#include "keyline/curve/view.h"

namespace keyline::curve {

/// A point of a curve nearest to a given one; of several the one of smallest parameter, as far as
/// rounding can tell them apart.
struct ClosestPoint {
  double t = 0;
  core::Point2 point;
  double distance = 0;
};

/// Global: Bézier and B-spline pieces are bounded by the Bernstein coefficients of the squared
/// distance and dropped when they cannot win; stationary points are isolated by sign changes of
/// its derivative, then refined by Newton's method. Polylines are exact.
ClosestPoint closest_point(const Bezier2& c, core::Point2 p);
ClosestPoint closest_point(const BSpline2& c, core::Point2 p);
ClosestPoint closest_point(const PiecewiseBezier& c, core::Point2 p);
ClosestPoint closest_point(const Polyline2& c, core::Point2 p);
/// For any other curve: each smooth stretch is cut in 16 and these in halves, up to four times,
/// while the distances of the ends less half the arc length between them leave room for a nearer
/// point; then Newton's method. Sound up to the estimate of the arc length (Simpson's rule and a
/// quarter) and as long as 1/256 of a stretch holds no two minima.
ClosestPoint closest_point(const PlanarView& c, core::Point2 p);
template <PlanarCurve C>
ClosestPoint closest_point(const C& c, core::Point2 p) {
  return closest_point(PlanarView(c), p);
}

}  // namespace keyline::curve
