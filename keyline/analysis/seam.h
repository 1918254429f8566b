#pragma once

#include "keyline/analysis/split.h"

namespace keyline::analysis {

/// Adds to `split`, the one of the curve with these options, what a curve that comes back to its
/// start has there, told as at an inner joint: corner, extrema and inflections, at t = 0; of an arc
/// or straight stretch over the start at its middle, with flat.low above flat.high. Pieces stay.
/// Such events are found by splitting the curve begun elsewhere.
void add_events_at_seam(const CurveView& curve, const ArcLengthTable& table,
                        const SplitOptions& options, Split& split);

}  // namespace keyline::analysis
