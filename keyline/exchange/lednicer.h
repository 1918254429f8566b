#pragma once

#include "keyline/acquire/raw_curve.h"

namespace keyline::exchange::detail {

/// Airfoils in Lednicer's order (the counts of both sides first, then the upper side from the nose,
/// then the lower side from the nose) to one curve from trailing edge over the nose to trailing
/// edge, with a note. False, and nothing is changed, for points that do not start so.
/// Precondition: the curve has points, and as many source lines.
bool unfold_lednicer(acquire::RawCurve& curve);

}  // namespace keyline::exchange::detail
