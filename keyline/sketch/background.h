#pragma once

#include <cstdint>

#include "keyline/sketch/image.h"
#include "keyline/sketch/tone.h"

namespace keyline::sketch {

/// Takes the paper's own brightness out of log levels, so that paper lies at Tone::kWhite all
/// over: its level is a high percentile of blocks of some 32 pixels, closed over (dark areas of up
/// to five blocks do not count as paper) and smoothed (but at steps: shadow_edge.h), and the
/// difference to white is added. `gain` is the a of y = a·log x.
/// Flatten::automatic does so only where the paper varies by more than 2 % of its light or is not
/// white. Returns whether it was done.
bool flatten_background(Raster<std::uint16_t>& level, double gain, Flatten flatten);

}  // namespace keyline::sketch
