#pragma once

#include <array>
#include <optional>

#include "keyline/lac/hermite/hermite.h"

/// Internals: the G1 problem without an inflection, and with one.
namespace keyline::lac::detail {

/// As solve_g1 for a turning up to 2 pi; a NaN is bad_input.
core::Result<SegmentSolution> solve_one_signed(const HandleAngles& angles, double alpha);

/// The curve of slope alpha < 0 through an inflection between directions from a chord of length 1:
/// its parts before and behind the inflection.
std::optional<std::array<Piece, 2>> solve_inflecting_arms(double from, double to, double alpha);

}  // namespace keyline::lac::detail
