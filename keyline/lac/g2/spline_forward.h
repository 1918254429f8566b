#pragma once

#include <span>

#include "keyline/lac/g2/spline.h"
#include "keyline/lac/g2/spline_start.h"

/// Internals of the G2 spline: from the first point on.
namespace keyline::lac::detail {

/// As solve_spline, but where several splines pass the points, the one found depends on where it
/// sets out and which way. `asked` tells failures what the spans are called in the request. Input
/// checked by the caller.
core::Result<SplineSolution> solve_spline_forward(std::span<const core::Point2> points,
                                                  const SplineOptions& options,
                                                  const SplineStart& asked);

/// Places the chain: its first span leads from `first` in `direction`.
void put_at(const core::Point2& first, double direction, SplineSolution& solution);

}  // namespace keyline::lac::detail
