#pragma once

#include <span>
#include <vector>

#include "keyline/lac/g2/spline.h"

/// Internals of the G2 spline: the way out where one piece per span would be wild.
namespace keyline::lac::detail {

/// Tangents from the turns at the points, curvatures from the G1 segments between them, then every
/// span for itself by solve_g2. Input checked by the caller; wanted: a slope per span.
core::Result<SplineSolution> solve_spline_span_by_span(std::span<const core::Point2> points,
                                                       const SplineOptions& options,
                                                       const std::vector<double>& wanted);

/// Largest distance of the chain's joints between spans, and of its end, from the points.
double deviation_of(std::span<const core::Point2> points, const SplineSolution& solution);

}  // namespace keyline::lac::detail
