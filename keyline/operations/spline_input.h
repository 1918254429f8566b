#pragma once

#include <string>

#include "keyline/core/error.h"
#include "keyline/curve/bspline.h"
#include "keyline/operations/values.h"

namespace keyline::operations {

/// Any curve value of the public interface as one B-spline in space.
struct SplineInput {
  curve::BSpline3 curve;
  double deviation = 0;  ///< bound of the distance from the given curve; 0: exact
  bool planar = true;    ///< given in the plane: all z are 0
};

/// Polylines, Béziers and B-splines exactly; log-aesthetic curves, in the plane or in space, within
/// `tolerance` (> 0); a path as its members end to end.
core::Result<SplineInput> spline_of(const AnyCurve& curve, double tolerance);

/// A size to measure tolerances by, wherever the curve lies: the longest side of the box of its
/// points, or the length of its log-aesthetic members. 1 where there is none.
double size_of(const AnyCurve& curve);

}  // namespace keyline::operations
