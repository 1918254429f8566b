#pragma once

#include <span>

#include "keyline/acquire/acquire.h"

namespace keyline::acquire {

/// One key-line from parts measured separately (bonnet, windscreen, roof), in any order and
/// direction. Each part is cleaned and ordered by itself, all in one common plane. The parts are
/// put end to end by their nearest ends, and reversed where needed. Where a part runs along the
/// next one for a while both are averaged, with weights that pass gradually from one to the other.
/// The direction is that of the first part. The report lists order, reversals, overlaps and gaps.
///
/// Returns bad-input where there is no part, or a part is no key-line or a closed outline.
core::Result<KeyLine> acquire_joined(std::span<const RawCurve> parts,
                                     const AcquireOptions& options = {});

}  // namespace keyline::acquire
