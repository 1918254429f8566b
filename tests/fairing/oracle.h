#pragma once

#include <vector>

#include "keyline/core/point.h"
#include "keyline/lac/chain/chain.h"

namespace keyline::fairing::testing {

/// What least squares makes of the points when it is told the true chain: started from it, with
/// its number of pieces and its kinds, everything else free. No answer that is not told the truth
/// can be expected to do better. Shares nothing with rooms fairing and lac but the chain's own
/// numbers: curvature from its definition, places by Simpson's rule, distances from a fine polygon,
/// derivatives by differences.
/// Precondition: points in order along the truth; noise in their unit, above 0.
lac::Chain oracle_fit(const lac::Chain& truth, const std::vector<core::Point2>& points,
                      double noise);

}  // namespace keyline::fairing::testing
