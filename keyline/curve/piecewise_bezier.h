#pragma once

#include <vector>

#include "keyline/core/similarity.h"
#include "keyline/curve/bezier.h"

namespace keyline::curve {

/// Bézier curves one after the other; models PlanarCurve, every piece taking an equal share of
/// [0, 1]. Functions throw InvalidInput if there is no piece.
struct PiecewiseBezier {
  std::vector<Bezier2> pieces;
  double deviation =
      0;  ///< bound of the distance from the curve they stand for; 0: the curve itself
};

core::Point2 evaluate(const PiecewiseBezier& c, double t);
Jet2 jet(const PiecewiseBezier& c, double t);
std::vector<double> breakpoints(const PiecewiseBezier& c);

PiecewiseBezier reverse(const PiecewiseBezier& c);
PiecewiseBezier transform(const PiecewiseBezier& c, const core::Similarity2& map);

}  // namespace keyline::curve
