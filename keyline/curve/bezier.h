#pragma once

#include <utility>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/core/similarity.h"
#include "keyline/curve/concept.h"
#include "keyline/curve/jet.h"

namespace keyline::curve {

/// Highest degree of a Bézier or B-spline curve the library works with.
inline constexpr int kMaxBezierDegree = 30;

/// Bézier curve of degree control.size() - 1, t in [0, 1]; rational where weights are given.
///
/// Functions below that take a curve require it to be valid in the sense of validate(): the
/// counts are checked (InvalidInput is thrown), the numbers are not.
template <class Point>
struct Bezier {
  std::vector<Point> control;
  std::vector<double> weights;  ///< one per control point, or empty: polynomial
  friend bool operator==(const Bezier&, const Bezier&) = default;
};
using Bezier2 = Bezier<core::Point2>;
using Bezier3 = Bezier<core::Point3>;

template <class P>
int degree(const Bezier<P>& c) {
  return static_cast<int>(c.control.size()) - 1;
}
template <class P>
bool is_rational(const Bezier<P>& c) {
  return !c.weights.empty();
}

/// Fails with bad_input and a path such as "control[3]" or "weights[0]" unless the degree is in
/// 1 … 30, all numbers are finite, and weights are absent or as many as points and positive.
template <class P>
core::Result<void> validate(const Bezier<P>& c);

/// De Casteljau; t is clamped to [0, 1].
template <class P>
P evaluate(const Bezier<P>& c, double t);
template <class P>
Jet<P> jet(const Bezier<P>& c, double t);
template <class P>
std::vector<double> breakpoints(const Bezier<P>&) {
  return {0.0, 1.0};
}

/// The parts over [0, t] and [t, 1], each again over [0, 1].
template <class P>
std::pair<Bezier<P>, Bezier<P>> split(const Bezier<P>& c, double t);
/// The part over [t0, t1], 0 <= t0 <= t1 <= 1.
template <class P>
Bezier<P> subcurve(const Bezier<P>& c, double t0, double t1);
/// The same points from the other end.
template <class P>
Bezier<P> reverse(const Bezier<P>& c);
/// The same curve with degree raised by `by` >= 0 (at most to kMaxBezierDegree).
template <class P>
Bezier<P> elevate_degree(const Bezier<P>& c, int by = 1);
Bezier2 transform(const Bezier2& c, const core::Similarity2& map);

}  // namespace keyline::curve
