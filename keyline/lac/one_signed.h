#pragma once

#include "keyline/lac/hermite.h"

/// Internals: the G1 problem without an inflection.
namespace keyline::lac::detail {

/// As solve_g1 for a turning up to 2 pi; a NaN is bad_input.
core::Result<SegmentSolution> solve_one_signed(const HandleAngles& angles, double alpha);

}  // namespace keyline::lac::detail
