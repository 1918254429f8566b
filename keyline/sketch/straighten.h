#pragma once

#include "keyline/core/error.h"
#include "keyline/sketch/image.h"
#include "keyline/sketch/trace.h"

namespace keyline::sketch {

/// The sheet of paper in a photo takes the photo's place, where one is given or, unless rectifying
/// is off, found; the result says so. Other pictures stay as they are.
/// Fails: bad_input for corners that are no sheet's.
core::Result<void> straighten(Image& image, const TraceOptions& options, TraceResult& result);

}  // namespace keyline::sketch
