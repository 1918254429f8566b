#pragma once

#include "keyline/curve/bspline.h"
#include "keyline/curve/curvature_graph.h"

namespace keyline::curve {

/// Curvature along the spline at 6,000 even steps of its parameter, from 0 to 1; lengths are those
/// of the polygon of these places.
CurvatureGraph curvature_graph(const BSpline2& spline);

}  // namespace keyline::curve
