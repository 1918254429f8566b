#pragma once

#include <optional>
#include <span>

#include "keyline/core/point.h"
#include "keyline/curve/curvature_graph.h"

namespace keyline::fit {

/// The graph of curvature of the smoothest quintic spline whose distance from every point is within
/// the tolerance: what any program has to offer, to compare with.
///
/// Method: a spline on even knots, two to a point up to 1,000, least squares plus a penalty on
/// third differences of its coefficients (a P-spline), the largest penalty that keeps the tolerance
/// found by bisection of its logarithm; once each over chord lengths, their roots and the points'
/// numbers, and of the three the one of least variation of curvature. Returns: nothing for fewer
/// than three points (through three goes a parabola, which no penalty counts), points of no extent,
/// or where no penalty keeps the tolerance.
/// Source: [Eilers 1996], penalised B-splines: many knots, and differences of the coefficients
///         kept small.
std::optional<curve::CurvatureGraph> smoothing_spline_curvature(
    std::span<const core::Point2> points, bool closed, double tolerance, int threads = 0);

}  // namespace keyline::fit
