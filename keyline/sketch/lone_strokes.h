#pragma once

#include <vector>

#include "keyline/core/point.h"
#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {

/// A line of several strokes goes with a stroke wherever that is alone beside it: what one stroke
/// drew by itself (a tongue of a flame, a corner) is no error of the hand, and the calm of a mean
/// is not asked for there. Within `over` along the line of where several strokes run it goes over
/// from the line as given. `reach`: how far from the line its strokes run.
std::vector<core::Point2> follow_lone_strokes(const SampledStroke& line,
                                              const std::vector<SampledStroke>& strokes,
                                              double reach, double over);

}  // namespace keyline::sketch
