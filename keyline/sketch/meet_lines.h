#pragma once

#include <vector>

#include "keyline/sketch/refine_stroke.h"

namespace keyline::sketch {

/// Ends that lie at another line (see FineStroke::free_start, free_end) are brought onto its
/// centre: lengthened along their direction, or shortened, by at most two and a half widths to the
/// place where they meet a stroke. Ends that meet none within that reach stay.
///
/// Where lines run together at a small angle their ink is one long before their centres meet, so
/// that thinning alone lets the stem end too early.
///
/// Where the pen went on beyond the line it met and stopped before their ink parted, the end lies
/// there; in ragged ink this cannot be seen.
void end_on_lines(std::vector<FineStroke>& strokes, const Refiner& refiner, bool ragged = false);

}  // namespace keyline::sketch
