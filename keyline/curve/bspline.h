#pragma once

#include <utility>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/core/point.h"
#include "keyline/core/similarity.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/concept.h"
#include "keyline/curve/jet.h"

namespace keyline::curve {

/// B-spline curve, rational (NURBS) where weights are given. With n control points there are
/// n + degree + 1 knots, clamped or not; the curve is what lies over [knots[degree], knots[n]].
/// The functions below take t in [0, 1], mapped linearly to that domain, and derivatives are in t.
///
/// They require a curve that is valid in the sense of validate(): counts and a domain of positive
/// length are checked (InvalidInput is thrown), the numbers are not.
template <class Point>
struct BSpline {
  int degree = 3;
  std::vector<double> knots;
  std::vector<Point> control;
  std::vector<double> weights;  ///< one per control point, or empty: polynomial
  friend bool operator==(const BSpline&, const BSpline&) = default;
};
using BSpline2 = BSpline<core::Point2>;
using BSpline3 = BSpline<core::Point3>;

template <class P>
bool is_rational(const BSpline<P>& c) {
  return !c.weights.empty();
}

/// Fails with bad_input and a path such as "knots[3]" unless: degree in 1 … 30; more control
/// points than degree; the right number of knots, not decreasing, none more than degree + 1 times
/// (degree + 1 inside the domain: the curve jumps there); a domain of positive length; all
/// numbers finite; weights absent or one per point and positive.
template <class P>
core::Result<void> validate(const BSpline<P>& c);

/// Range of knot values the curve is defined over.
template <class P>
core::Interval domain(const BSpline<P>& c);
/// Knot value at t and back (up to rounding).
template <class P>
double knot_at(const BSpline<P>& c, double t) {
  return core::at(domain(c), t);
}
/// The same, but the very knot where t is one of breakpoints().
template <class P>
double exact_knot_at(const BSpline<P>& c, double t);
template <class P>
double parameter_at_knot(const BSpline<P>& c, double u) {
  const core::Interval d = domain(c);
  return (u - d.low) / (d.high - d.low);
}

/// De Boor; O(degree^2), no allocation.
template <class P>
P evaluate(const BSpline<P>& c, double t);
template <class P>
Jet<P> jet(const BSpline<P>& c, double t);
/// The distinct knots of the domain, as t.
template <class P>
std::vector<double> breakpoints(const BSpline<P>& c);

/// The same curve with knot value u (inside the domain) inserted `times` more times, up to
/// multiplicity degree + 1 (Boehm).
template <class P>
BSpline<P> insert_knot(const BSpline<P>& c, double u, int times = 1);
/// The same curve with several knot values inserted; inserted is sorted.
template <class P>
BSpline<P> refine_knots(const BSpline<P>& c, const std::vector<double>& inserted);
/// The same curve with end knots of multiplicity degree + 1, cut to its domain.
template <class P>
BSpline<P> clamp_ends(const BSpline<P>& c);
/// One Bézier curve of the same degree for each non-empty knot span of the domain.
template <class P>
std::vector<Bezier<P>> to_beziers(const BSpline<P>& c);
/// The same curve with degree raised by `by`; every knot's multiplicity grows by as much.
template <class P>
BSpline<P> elevate_degree(const BSpline<P>& c, int by = 1);

template <class P>
std::pair<BSpline<P>, BSpline<P>> split(const BSpline<P>& c, double t);
template <class P>
BSpline<P> subcurve(const BSpline<P>& c, double t0, double t1);
/// Over the same domain [a, b]; over [-b, -a] where knots would fall together that differ.
template <class P>
BSpline<P> reverse(const BSpline<P>& c);
BSpline2 transform(const BSpline2& c, const core::Similarity2& map);

}  // namespace keyline::curve
