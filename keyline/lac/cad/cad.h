#pragma once

#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/lac/chain/chain.h"
#include "keyline/lac/segment/segment.h"

/// Log-aesthetic curves as the curves CAD systems read.
namespace keyline::lac {

struct CadOptions {
  int degree = 3;           ///< 3 or 5
  double tolerance = 1e-4;  ///< largest distance, > 0, in the document's unit
  /// Keep the curvature of every Bézier monotone where the segment's is, with more pieces if need
  /// be, down to 1 % of its length. Otherwise only the number of pieces counts.
  bool monotone = true;
};

/// A G1 Bézier spline: every piece begins and ends on the curve, tangent to it.
struct CadBeziers {
  std::vector<curve::Bezier2> pieces;
  double deviation = 0;  ///< bound of the distance from the curve, never above the tolerance
  int not_monotone = 0;  ///< pieces whose monotone curvature could not be had or certified
};

/// The curve within options.tolerance as Béziers of the given degree, the fewest of their kind:
/// each is as long as the tolerance allows, the last ends with the curve. Pieces end at joints and
/// inflections of the curve too. A straight line is one piece.
///
/// The handles of a cubic are those whose normal distance vanishes at 0.337 and 0.663 of the arc
/// length, which makes the three waves of the error t^2 (1-t)^2 (x^2 - c) equally high: the least
/// largest error to leading order (length^6). Quintics meet the end curvatures and have the least
/// deviation (QuasiForm::best).
/// The deviation is bounded, not sampled: Taylor series of the segment with Cauchy's remainder, the
/// difference a polynomial bounded from its Chebyshev nodes (see deviation.h).
/// Fails: bad_input (curve, degree, tolerance), not_converged where the tolerance is below what
/// doubles can do (1e-13 of the length) or needs more than 100,000 pieces.
core::Result<CadBeziers> to_beziers(const Segment& segment, const CadOptions& options);
core::Result<CadBeziers> to_beziers(const Chain& chain, const CadOptions& options);

struct CadSpline {
  curve::BSpline2 curve;
  double deviation = 0;
  int not_monotone = 0;
};

/// The same as one B-spline, with knots of full multiplicity at the joints of the Béziers.
core::Result<CadSpline> to_bspline(const Segment& segment, const CadOptions& options);
core::Result<CadSpline> to_bspline(const Chain& chain, const CadOptions& options);

/// Exact NURBS of a chain of circular arcs and straight lines, rational quadratic, each Bézier
/// turning by at most a right angle; a chain of lines alone gives degree 1.
/// Fails: bad_input; unsupported where a piece is neither (its path names it).
core::Result<curve::BSpline2> exact_nurbs(const Chain& chain);
inline core::Result<curve::BSpline2> exact_nurbs(const Segment& segment) {
  return exact_nurbs(chain_of(segment));
}

}  // namespace keyline::lac
