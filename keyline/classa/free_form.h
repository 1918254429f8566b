#pragma once

#include <functional>
#include <optional>

#include "keyline/classa/cav.h"
#include "keyline/classa/nearest.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/piecewise_bezier.h"
#include "keyline/curve/view.h"

namespace keyline::classa {

/// A free-form curve as one polynomial Bézier curve ([Oya] section 3.3, step 2).
struct Approximation {
  curve::Bezier2 curve;
  bool exact = false;    ///< it was one already
  double deviation = 0;  ///< bound of the largest distance between the two curves, either way
  double tolerance = 0;  ///< it was asked to meet
};

/// The given curve once more, as polynomial Béziers end to end whose `deviation` bounds their
/// distance from it, at most the tolerance it is called with.
using PiecesWithin = std::function<core::Result<curve::PiecewiseBezier>(double tolerance)>;

/// The Bézier curve of the lowest degree 3 … 8 within the tolerance (a length; empty: 1e-3 of the
/// size of the curve), end points and end tangents kept. The deviation is bounded from the pieces
/// (deviation_bound), to about 2 % of itself or of the tolerance; without `pieces` these are
/// approximate_by_cubics', whose own share of the bound is rigorous only for Béziers, B-splines
/// and polylines. Errors: not_converged where degree 8 does not meet it, with the deviation
/// reached; bad_input for a tolerance that is not positive or a curve without length or with
/// coinciding points at its ends; as `pieces`.
core::Result<Approximation> approximate(const curve::PlanarView& c,
                                        std::optional<double> tolerance = {},
                                        const PiecesWithin& pieces = {});

/// A curve with its value, and for types 4 and 5 with the nearest curve that has one matrix.
struct Evaluation {
  Approximation approximation;
  CurveValue value;
  std::optional<NearestCurve> nearest;
  std::optional<CurveValue> nearest_value;  ///< with conditions of its own
};

/// cav() of the approximation and, for types 4 and 5, of the nearest curve.
core::Result<Evaluation> evaluate_curve(Approximation approximation, const CavOptions& options);

}  // namespace keyline::classa
