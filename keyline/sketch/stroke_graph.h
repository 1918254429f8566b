#pragma once

#include <vector>

#include "keyline/core/point.h"
#include "keyline/sketch/thinning.h"

namespace keyline::sketch {

/// Where lines end (degree 1) or meet (3 or more). Positions in pixels, y down.
struct GraphNode {
  core::Point2 position;
  double radius = 0;       ///< half the ink's width there
  std::vector<int> edges;  ///< indices; an edge that returns is listed twice
};

/// A line between two nodes, or a closed one without nodes (from and to are -1). Points run from
/// the node `from` to the node `to`, pixel centre by pixel centre.
struct GraphEdge {
  int from = -1;
  int to = -1;
  std::vector<core::Point2> points;
  std::vector<float> radii;  ///< half the ink's width at the points
  bool alive = true;
};

/// A piece of ink hardly longer than broad.
struct GraphDot {
  core::Point2 at;         ///< its middle
  double radius = 0;       ///< of a disc as large
  std::vector<int> edges;  ///< what thinning made of it; none of what was left out
};

/// The lines of a thinned picture as a graph.
struct StrokeGraph {
  std::vector<GraphNode> nodes;
  std::vector<GraphEdge> edges;
  std::vector<GraphDot> dots{};  ///< as far as they were looked for (find_dots.h)
};

/// The graph of `lines`, thinned from `ink`. Single pixels and blobs whose line is shorter than
/// they are wide give an edge of one point or few. Spurs (ends that hardly leave the width of the
/// line they sit on) are cut and the lines through their feet made one. Of two edges around a hole
/// no wider than the line it lies in one stays. Where the ink is ragged no short end is spared.
StrokeGraph build_graph(const Binary& lines, const Binary& ink, bool ragged = false);

/// Length along the points.
double length_of(const GraphEdge& edge);

}  // namespace keyline::sketch
