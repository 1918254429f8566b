#pragma once

#include <span>

#include "keyline/acquire/acquire.h"

namespace keyline::acquire {

/// One key-line from parts measured apart (bonnet, windscreen, roof), in any order and direction:
/// every part becomes a key-line of its own (strays and order handled there) in one common plane,
/// the parts are put end to end by their nearest ends, turned round where needed, and where a part
/// runs along the next one for a while both are averaged, handing over gradually from one to the
/// other. The direction is that of the first part. The report tells order, turns, overlaps, gaps.
///
/// Returns bad-input where there is no part, a part is none, or a part is a closed outline.
core::Result<KeyLine> acquire_joined(std::span<const RawCurve> parts,
                                     const AcquireOptions& options = {});

}  // namespace keyline::acquire
