#pragma once

#include <span>

#include "keyline/lac/g2/spline.h"

/// Internals of the G2 spline: from the first point on.
namespace keyline::lac::detail {

/// As solve_spline, but where several splines pass the points, the one found depends on which end
/// is named first.
core::Result<SplineSolution> solve_spline_forward(std::span<const core::Point2> points,
                                                  const SplineOptions& options);

}  // namespace keyline::lac::detail
