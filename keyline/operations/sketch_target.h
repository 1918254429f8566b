#pragma once

#include <array>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/sketch/stroke_curve.h"

namespace keyline::operations {

/// A curvature wanted of a traced line: the line's number, where on it (fraction of its length, 0
/// to 1), the curvature in 1 / pixel, positive turning left.
using WantedPlace = std::array<double, 3>;

/// Drives the named lines to the curvatures wanted of them, points drawn over the curvature graph
/// ([Sketch] Fig. 18): ends held, joints G2. Their targets and errors are those of this; what was
/// reached and how far the lines moved is added to `notes` (lengths in `unit`, `scale` of them a
/// pixel).
/// Fails: bad_input for lines that are not there, places outside [0, 1], fewer than two places of a
/// line; what fit::drive_curvature fails with.
core::Result<void> follow_wanted(const std::vector<WantedPlace>& wanted,
                                 std::vector<sketch::Stroke>& strokes, double scale,
                                 const std::string& unit, std::vector<std::string>& notes);

}  // namespace keyline::operations
