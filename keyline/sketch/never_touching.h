#pragma once

#include <cstddef>
#include <vector>

#include "keyline/sketch/stroke_grid.h"
#include "keyline/sketch/two_lines.h"

namespace keyline::sketch {

/// Finds groups of a picture's strokes that are two lines since they nowhere touch.
///
/// Passes of one line wander into each other's ink; edges drawn beside each other keep their gap
/// all along. Strokes touch that come within `near` of each other in directions that differ by less
/// than `angle`, and with them go all that touch them. Where passes are drawn strokes, this says
/// nothing: a loose hand's may lie apart all along.
std::vector<TwoLines> never_touching(const std::vector<SampledStroke>& strokes,
                                     const std::vector<std::vector<std::size_t>>& groups,
                                     double near, double angle);

}  // namespace keyline::sketch
