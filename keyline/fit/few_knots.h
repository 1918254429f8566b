#pragma once

#include <optional>
#include <span>

#include "keyline/core/point.h"
#include "keyline/curve/curvature_graph.h"

namespace keyline::fit {

/// The graph of curvature of a quintic smoothing spline of few knots, by chord length, whose
/// distance from every point is within the tolerance. It has fewer waves than that of
/// smoothing_spline_curvature(), whose many knots let it ripple, and mostly more variation. A
/// closed one is periodic.
///
/// Method: knots are laid at points, in the middle of where the squares of the offsets sum up to
/// most, until the spline of least squares keeps the tolerance; then the largest penalty on jumps
/// of the fifth derivative that keeps it is found by bisection of its logarithm.
/// Returns: nothing for fewer than eight different points in a row, or where a thousand knots do
///          not keep the tolerance.
/// Source: [Dierckx 1993], ch. 5 (FITPACK's smoothing splines), with the largest offset in place
///         of the sum of squares.
std::optional<curve::CurvatureGraph> few_knots_curvature(std::span<const core::Point2> points,
                                                         bool closed, double tolerance);

}  // namespace keyline::fit
