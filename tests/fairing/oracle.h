#pragma once

#include <vector>

#include "keyline/fairing/fair.h"
#include "keyline/lac/chain/chain.h"

namespace keyline::fairing::testing {

/// What least squares makes of the points when it is told the true chain: started from it, with
/// its number of pieces and its kinds, everything else free. The free ends are placed as `fair`
/// places them. No answer that is not told the truth can be expected to do better.
/// Precondition: points in order along the truth; noise in their unit, above 0.
FairResult oracle_fit(const lac::Chain& truth, const std::vector<core::Point2>& points,
                      double noise);

}  // namespace keyline::fairing::testing
