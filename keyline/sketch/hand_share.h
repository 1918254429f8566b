#pragma once

#include <vector>

#include "keyline/sketch/pass_evidence.h"

namespace keyline::sketch {

/// What the hand errs as a share of its way, as far as the strokes show it: at most the model's.
///
/// A careful hand's lines may run beside each other where a loose one's would be passes of one. Of
/// every stroke that has others beside it, the distance of the nearest is taken, as a share of its
/// length; passes of one line lie as far apart as ten times what is usual of it.
double hand_share(const std::vector<SampledStroke>& strokes, const PassModel& model);

}  // namespace keyline::sketch
