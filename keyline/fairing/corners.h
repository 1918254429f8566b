#pragma once

#include <functional>
#include <vector>

#include "keyline/fairing/run.h"

/// Chains that share a corner.
namespace keyline::fairing::detail {

/// What a run is solved with.
using OptionsOf = std::function<RunOptions(std::size_t run)>;

/// Neighbouring chains end in one place at a corner: half way between their ends, or nearer to the
/// corner's own point where that would leave the tolerance; elsewhere between their ends where the
/// calmest chain's pieces come only there without another wave. `round`: the last run meets the
/// first. Clamped ends stay where they are. The splines, of each run, are what clamps are read off;
/// they may be missing where nothing is clamped.
void tie_corners(std::vector<Run>& runs, std::vector<RunResult>& solved,
                 const std::vector<curve::BSpline2>& splines, const OptionsOf& options, bool round);

}  // namespace keyline::fairing::detail
