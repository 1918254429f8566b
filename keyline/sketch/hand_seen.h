#pragma once

#include <vector>

#include "keyline/sketch/pass_evidence.h"

namespace keyline::sketch {

/// How far passes lie apart, as far as the strokes show how the hand errs: `at_most` with `apart`
/// and `hand` lowered.
///
/// A careful hand's lines may run beside each other where a loose one's would be passes of one. Of
/// every stroke that has others beside it, the distance of the nearest is taken: passes of one line
/// lie as far apart as five times what is usual along all of them, in widths, but a width at least
/// (their ink touches), and ten times what is usual of strokes, as a share of their length; of
/// one stroke, ten times what is usual along it.
PassReach hand_seen(const std::vector<SampledStroke>& strokes, const PassModel& at_most);

}  // namespace keyline::sketch
