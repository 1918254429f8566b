#pragma once

#include <cstddef>
#include <vector>

#include "keyline/sketch/consolidate.h"
#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {

/// The one line that a group of strokes stands for.
///
/// A middle one of the long strokes is taken for a spine, prolonged by what of the others runs past
/// its ends, and closed where it runs into itself. All strokes are aligned with it in order (see
/// align) and the line is the mean of what lies beside each of its samples, so that lines that wind
/// around or cross themselves come out as they were drawn.
///
/// members: indices into strokes; one alone gives that stroke.
/// strays:  members of which less than half runs beside the line found; they are not its members.
/// reach:   how far apart strokes of one line lie. step: spacing of samples. angle: radians.
MeantLine meant_line(const std::vector<SampledStroke>& strokes,
                     const std::vector<std::size_t>& members, double step, double reach,
                     double angle, std::vector<std::size_t>& strays);

}  // namespace keyline::sketch
