#pragma once

#include <cstddef>
#include <vector>

#include "keyline/sketch/pass_evidence.h"
#include "keyline/sketch/stroke_grid.h"
#include "keyline/sketch/two_lines.h"

namespace keyline::sketch {

/// Finds strokes of a picture that are put together and are two edges, since they keep their
/// distance.
///
/// Passes of one line wander to and from each other; the two edges of something thin were meant to
/// run evenly. Two strokes of a group are two lines, touch where they may, if of the one, thirty
/// widths long at least, three quarters lie next to the other (on that side nothing is nearer), at
/// a distance that differs from the usual one by an eighth at most, which is one and a half widths
/// at least: so there is paper between.
///
/// at_most: what lies farther apart than passes of any hand, in another direction than they do, is
/// not beside.
std::vector<TwoLines> double_edges(const std::vector<SampledStroke>& strokes,
                                   const std::vector<std::vector<std::size_t>>& groups,
                                   const PassModel& at_most);

}  // namespace keyline::sketch
