#pragma once

#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"

namespace keyline::curve {

/// Whether signed curvature only rises, or only falls, along a curve.
struct MonotoneVerdict {
  enum Answer {
    yes,       ///< certified: dkappa/ds never changes sign (constant curvature included)
    no,        ///< certified: it does, and curvature goes back by more than the tolerance
    undecided  ///< neither: it goes back by no more than the tolerance, or a double zero of
               ///< dkappa/ds or a cusp could not be told from a change of sign
  };
  Answer answer = undecided;
  /// Direction of most of the change: 1 rising, -1 falling, 0 constant (or a curve without length).
  int direction = 0;
  /// Unless yes: a parameter where curvature goes against `direction`, or the place in doubt.
  double witness = 0;
  /// How far curvature goes back there, as a fraction (see tolerance); 0 where nothing goes back.
  double backward = 0;
};

/// Certifies monotone curvature of a Bézier curve, rational or not.
///
/// The numerator of dkappa/ds is formed in Bernstein form: D'V - 3DA with D = x'y''-y'x'',
/// V = x'^2+y'^2, A = x'x''+y'y'' (degree 4n-6); for a rational curve h = (X, Y, W), with
/// N = (X, Y)'W - (X, Y)W', (3W' det + W det')|N|^2 - 3 W det (N.N'), det = |h, h', h''|. Its sign
/// is read off the coefficients, on subdivided parts where they differ: first in doubles that
/// carry their rounding-error bounds, then, if those leave a doubt, in integers, exactly. Nothing
/// is sampled: the answer yes holds for the given numbers as they are, bit for bit.
///
/// `tolerance` (>= 0) is about the answer no: stretches against the main direction on which
/// curvature changes by less than `tolerance` times its size there (or times 1/length of the
/// control polygon, if that is more) do not make one. They are what rounding makes of a circle, a
/// straight line or a vertex at the very end of the curve.
///
/// A straight line is monotone; so is a curve whose curvature is infinite at an end. A cusp inside
/// is not, a curve without length is undecided. Throws InvalidInput on wrong counts.
MonotoneVerdict certify_monotone_curvature(const Bezier2& c, double tolerance = 1e-9);

/// The same for every piece of a B-spline and for its joints, where curvature may jump: a jump of
/// less than the tolerance is taken for rounding, a larger one in the main direction is allowed, a
/// corner (tangent turning by more than the tolerance) is not. The answer concerns the Bézier
/// pieces as to_beziers() rounds them; `witness` is a parameter of the spline.
MonotoneVerdict certify_monotone_curvature(const BSpline2& c, double tolerance = 1e-9);

}  // namespace keyline::curve
