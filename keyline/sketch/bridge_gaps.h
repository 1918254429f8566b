#pragma once

#include <vector>

#include "keyline/sketch/branch.h"
#include "keyline/sketch/join_strokes.h"
#include "keyline/sketch/stroke_graph.h"

namespace keyline::sketch {

/// Free ends that face each other go on with each other: over the gap of paper and by less than the
/// turn that the options allow (or a free end with one that touches another line, straight on), and
/// over longer gaps in a row of dashes (where it allows them): even gaps that follow each other
/// along a line that bends little. `branches`: of all edges, those at the start and the end of edge
/// e at 2 e and 2 e + 1.
void bridge_gaps(const StrokeGraph& graph, const JoinOptions& options,
                 std::vector<Branch>& branches);

}  // namespace keyline::sketch
