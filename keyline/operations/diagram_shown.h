#pragma once

#include "keyline/analysis/lddc.h"
#include "keyline/operations/curve_analyze.h"

namespace keyline::operations {

/// A diagram as results have it: bars that are not empty, the C curve and its ends.
LddcGraph shown(const analysis::Lddc& lddc);

}  // namespace keyline::operations
