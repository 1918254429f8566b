#pragma once

#include <vector>

#include "keyline/sketch/branch.h"
#include "keyline/sketch/stroke_graph.h"

namespace keyline::sketch {

/// Rows of dots, and dots of a row of dashes (chain lines): one after the other over gaps as even
/// as those between dashes, along a line that bends as little. A dot has no direction of its own:
/// its neighbours in the row tell it.
///
/// A row goes on from free ends of lines that lead to it and have another gap as long, as dashes
/// do. One of dots alone has five at least, at an even pitch. Most of the dots of a row have no
/// other dot nearer than half as far again as the next of the row: dots that lie beside each other
/// too are shading, or a screen.
///
/// Those of a row go on with each other; an edge of one point takes the place of what thinning made
/// of a dot. `branches`: of all edges, those at the start and the end of edge e at 2 e and 2 e + 1.
void join_rows_of_dots(StrokeGraph& graph, std::vector<Branch>& branches);

}  // namespace keyline::sketch
