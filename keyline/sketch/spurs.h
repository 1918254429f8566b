#pragma once

#include "keyline/sketch/stroke_graph.h"

namespace keyline::sketch {

/// Takes an edge off a node's list.
void detach(StrokeGraph& graph, int node, int edge);

/// The two lines at a node left with two become one; a line that returns to it becomes closed.
void join_at(StrokeGraph& graph, int node);

/// The line that goes on in a short end, having crossed the one that the end sits on: an arm on the
/// far side of the crossing (at the end's foot, or where lines that cross at a small angle run
/// together) leads to its tip, which is clear of the other line. -1 where there is none, or the end
/// is not short.
int leading_arm(const StrokeGraph& graph, int end);

/// Cuts ends that hardly leave the width of the line they sit on, shortest first, and makes the
/// lines through their feet one. A line that forks into the two corners of its end ends at the
/// fork; of another forked end the longer fork stays as the line's end; an end with a leading arm
/// stays too, where such are spared.
void prune_spurs(StrokeGraph& graph, bool spare);

}  // namespace keyline::sketch
