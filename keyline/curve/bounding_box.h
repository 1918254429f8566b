#pragma once

#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/piecewise_bezier.h"
#include "keyline/curve/polyline.h"
#include "keyline/curve/view.h"

namespace keyline::curve {

/// Axis-parallel box.
struct Box2 {
  core::Point2 low;
  core::Point2 high;
  friend bool operator==(const Box2&, const Box2&) = default;
};

inline double width(const Box2& b) { return b.high.x - b.low.x; }
inline double height(const Box2& b) { return b.high.y - b.low.y; }
/// Length of the box's diagonal.
inline double diagonal(const Box2& b) { return norm(b.high - b.low); }
inline bool contains(const Box2& b, core::Point2 p) {
  return b.low.x <= p.x && p.x <= b.high.x && b.low.y <= p.y && p.y <= b.high.y;
}
/// How far a point is from a box; 0 within.
double distance(const Box2& b, core::Point2 p);
Box2 united(const Box2& a, const Box2& b);
Box2 united(const Box2& a, core::Point2 p);

/// Smallest box around the curve. For Bézier, B-spline and polyline all extrema are found (roots
/// of the coordinates' derivatives in Bernstein form): tight to rounding.
Box2 bounding_box(const Bezier2& c);
Box2 bounding_box(const BSpline2& c);
Box2 bounding_box(const PiecewiseBezier& c);
Box2 bounding_box(const Polyline2& c);
/// For any other curve extrema are sought among 32 parts of every smooth stretch: two extrema of
/// one coordinate within one part may be missed.
Box2 bounding_box(const PlanarView& c);
template <PlanarCurve C>
Box2 bounding_box(const C& c) {
  return bounding_box(PlanarView(c));
}

}  // namespace keyline::curve
