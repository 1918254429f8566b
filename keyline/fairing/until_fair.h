#pragma once

#include <functional>

#include "keyline/fairing/fair.h"

namespace keyline::fairing::detail {

/// Smoothness to begin with: nothing but the noise and what the tolerance holds beyond it counts.
inline constexpr double kNearAsNoise = 0.5;

/// One answer, given the best before it or none.
using Solve = std::function<core::Result<FairResult>(const FairOptions&, const FairResult* before)>;

/// The answer nearest to its points that is fair: of smoothnesses from 0.5 to 1, each twice as far
/// from the first as the one before, the first whose answer is. Else the one that is least unfair,
/// by its waves beyond those of the spline it is held against, then by its energy or jolt, of those
/// that depart by no more than the noise. Notes say where it is not the first. One solve
/// where a smoothness is asked for or counts for nothing. Fills `fairness` in. `solve` is given the
/// best answer before too, or none: its splines (step 2) are those of every smoothness.
///
/// Where errors of neighbours are alike, estimates of the noise are too small, and an answer as
/// near as they are follows waves that any spline within the tolerance is free of. There (see
/// acquire::noise_stays) 0.75 and 1 alone are tried, however far off.
///
/// Pieces to be read otherwise are counted as in the answer without: that is found first, and its
/// smoothness kept.
core::Result<FairResult> until_fair(const acquire::KeyLine& line, const FairOptions& options,
                                    const Solve& solve);

}  // namespace keyline::fairing::detail
