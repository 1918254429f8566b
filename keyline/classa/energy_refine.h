#pragma once

#include "keyline/classa/reach.h"

namespace keyline::classa::detail {

/// The minimum of strain energy that belongs to a start: SLSQP near to it, then Newton's method
/// inside the region or golden section along its edge; the end is met exactly. Never worse than the
/// start, which has to be feasible.
Candidate refine(const Frame& f, const ReachTable& table, const Candidate& start);

}  // namespace keyline::classa::detail
