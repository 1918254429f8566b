#pragma once

#include <vector>

#include "keyline/sketch/pass_evidence.h"

namespace keyline::sketch {

/// How far the hand errs, as far as the strokes show it: `most` with `apart` and `hand` lowered.
///
/// A careful hand's lines may run beside each other where a loose one's would be passes of one. Of
/// every stroke that has others beside it, the distance of the nearest is taken: passes of one line
/// lie as far apart as five times what is usual along all of them, in widths, but a width at least
/// (their ink touches), and ten times what is usual of strokes, as a share of their length.
PassModel hand_seen(const std::vector<SampledStroke>& strokes, const PassModel& most);

}  // namespace keyline::sketch
