#pragma once

#include <functional>

#include "keyline/fairing/fair.h"

namespace keyline::fairing::detail {

/// Smoothness to begin with: nothing but the noise and what the tolerance holds beyond it counts.
inline constexpr double kNearAsNoise = 0.5;

/// The answer nearest to its points that is fair: of the smoothnesses 0.5, 0.75 and 1 the first
/// whose answer is, else the one that is least unfair, by its waves beyond those of the spline it
/// is held against, then by its energy or jolt. Notes say where it is not the first. One solve
/// where a smoothness is asked for or counts for nothing. Fills `fairness` in. `solve` is given the
/// best answer before too, or none: its splines (step 2) are those of every smoothness.
///
/// Where errors of neighbours are alike, estimates of the noise are too small, and an answer as
/// near as they are follows waves that any spline within the tolerance is free of.
core::Result<FairResult> until_fair(
    const acquire::KeyLine& line, const FairOptions& options,
    const std::function<core::Result<FairResult>(const FairOptions&, const FairResult* before)>&
        solve);

}  // namespace keyline::fairing::detail
