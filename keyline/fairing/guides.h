#pragma once

#include <vector>

#include "keyline/fairing/chain_fit.h"

namespace keyline::fairing::detail {

/// The points with guides put into gaps so wide that a chain could wander between them while it
/// passes within `tolerance` of every point: two in each such gap, on the centripetal
/// Catmull-Rom curve, which makes no loops. A guide pulls little and forbids only departures of
/// more than a tenth of the gap. Guides have count 0. All lengths are fractions of the whole.
std::vector<FitPoint> with_guides(const std::vector<FitPoint>& points, bool closed,
                                  double tolerance);

}  // namespace keyline::fairing::detail
