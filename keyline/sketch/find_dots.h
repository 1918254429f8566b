#pragma once

#include "keyline/sketch/dash_row.h"
#include "keyline/sketch/stroke_graph.h"
#include "keyline/sketch/thinning.h"

namespace keyline::sketch {

/// Finds the graph's dots: of small pieces that were left out, and of the ink it was made from. A
/// dot is no more than twice as long as broad, the grid's pixel aside.
void find_dots(const Binary& ink, const InkPieces& left_out, StrokeGraph& graph);

}  // namespace keyline::sketch
