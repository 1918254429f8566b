#pragma once

#include <utility>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/core/similarity.h"
#include "keyline/curve/concept.h"
#include "keyline/curve/jet.h"

namespace keyline::curve {

/// Points joined by straight edges. The parameter runs evenly over the edges: point i of n stands
/// at t = i / (n - 1). Curvature is 0 on the edges; vertices are breakpoints.
/// Functions throw InvalidInput if there are fewer than two points.
template <class Point>
struct Polyline {
  std::vector<Point> points;
  friend bool operator==(const Polyline&, const Polyline&) = default;
};
using Polyline2 = Polyline<core::Point2>;
using Polyline3 = Polyline<core::Point3>;

/// Fails with bad_input and a path such as "points[2]" unless there are two or more points, all
/// finite. Repeated points are allowed.
template <class P>
core::Result<void> validate(const Polyline<P>& c);
/// The jet on an edge of no length is 0 but for its third derivative, which is the way on.
template <class P>
P evaluate(const Polyline<P>& c, double t);
template <class P>
Jet<P> jet(const Polyline<P>& c, double t);
template <class P>
std::vector<double> breakpoints(const Polyline<P>& c);

/// The parts before and after t; either may consist of a repeated end point.
template <class P>
std::pair<Polyline<P>, Polyline<P>> split(const Polyline<P>& c, double t);
template <class P>
Polyline<P> subcurve(const Polyline<P>& c, double t0, double t1);
template <class P>
Polyline<P> reverse(const Polyline<P>& c);
Polyline2 transform(const Polyline2& c, const core::Similarity2& map);

}  // namespace keyline::curve
