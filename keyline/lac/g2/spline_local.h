#pragma once

#include <span>
#include <vector>

#include "keyline/lac/g2/g2_hermite.h"
#include "keyline/lac/g2/spline.h"
#include "keyline/lac/g2/spline_start.h"

/// Internals of the G2 spline: the way out where one piece per span would be wild.
namespace keyline::lac::detail {

/// One span between directions and curvatures.
struct SpanCurve {
  Chain chain;
  bool overridden = false;  ///< of slope -1: there is none of the slope wanted, or it has a needle
};
/// By solve_g2; fails as that does for the slope wanted where there is none of slope -1 either.
core::Result<SpanCurve> solve_span(const CurvatureElement& start, const CurvatureElement& end,
                                   double wanted);

/// Tangents from the turns at the points, curvatures from the G1 segments between them, then every
/// span for itself by solve_span. Input checked by the caller; wanted: a slope per span; asked: as
/// for solve_spline_forward.
core::Result<SplineSolution> solve_spline_span_by_span(std::span<const core::Point2> points,
                                                       const SplineOptions& options,
                                                       const std::vector<double>& wanted,
                                                       const SplineStart& asked);

/// Largest distance of the chain's joints between spans, and of its end, from the points.
double deviation_of(std::span<const core::Point2> points, const SplineSolution& solution);

}  // namespace keyline::lac::detail
