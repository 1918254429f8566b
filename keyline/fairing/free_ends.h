#pragma once

#include "keyline/fairing/run.h"

namespace keyline::fairing::detail {

/// Lengthens or shortens a noisy run's chain at its free ends. The last point alone says where a
/// curve ends no better than to its own error; where points follow one another evenly (their places
/// along the chain are a straight line or a parabola of their number, to within the noise), that
/// line through the last two dozen says it two to three times better. Ends that are clamped, tied,
/// closed or to pass their last point stay, and so do those whose last point would leave the
/// tolerance.
void place_free_ends(RunResult& result, const Run& run, const RunOptions& options);

}  // namespace keyline::fairing::detail
