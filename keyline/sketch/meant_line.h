#pragma once

#include <cstddef>
#include <vector>

#include "keyline/sketch/consolidate.h"
#include "keyline/sketch/pass_evidence.h"
#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {

struct LineOptions {
  double width = 1;  ///< of the pen that the line is held to
  double step = 1;   ///< between samples
  PassModel passes;  ///< how far apart strokes of the line lie
};

/// The one line that a group of strokes stands for.
///
/// The strokes are laid along each other in their order of passage (strip.h), so that lines that
/// wind around or cross themselves come out as they were drawn; the line runs along their middle,
/// is closed where it runs into itself, moved to the mean of what lies beside each of its samples,
/// and held within a width of the pen of a stroke wherever strokes lie farther apart. Where more
/// than 2 % of it would still lie farther than one and a half widths from all strokes, there is no
/// such line, and the longest stroke is taken in place of those that run beside it.
///
/// members: indices into strokes; one alone gives that stroke.
/// strays:  members of which less than two thirds run beside the line found, no farther from it
/// than
///          passes of their own length may lie apart; they are not its members, and the line is
///          that of the others alone.
MeantLine meant_line(const std::vector<SampledStroke>& strokes,
                     const std::vector<std::size_t>& members, const LineOptions& options,
                     std::vector<std::size_t>& strays);

}  // namespace keyline::sketch
