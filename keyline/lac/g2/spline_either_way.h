#pragma once

#include <span>

#include "keyline/lac/g2/spline.h"

namespace keyline::lac {

/// solve_spline from the first point on or from the last, told by the chords and slopes alone:
/// where there are several splines the one found is the same whichever end is named first, in a
/// mirror and of another size (a closed one: whichever way it is travelled from the same point).
/// Fails as solve_spline.
core::Result<SplineSolution> solve_spline_either_way(std::span<const core::Point2> points,
                                                     const SplineOptions& options = {});

}  // namespace keyline::lac
