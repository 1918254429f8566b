#pragma once

#include "keyline/sketch/stroke_graph.h"

namespace keyline::sketch {

/// Half widths: two lines that cross at 10 degrees share about 23 of them, 1 / tan 5 degrees twice;
/// up to the shorter one directions beside the stretch tell who goes on with whom.
inline constexpr double kShortShared = 4;
inline constexpr double kLongestShared = 24;

/// True where two lines cross at a small angle along this edge: its four neighbours pair up
/// across it, nearly straight; the longer it is, the straighter. Or one of them is a short end that
/// a line on the other side leads to.
bool is_shared_stretch(const StrokeGraph& graph, int edge);

}  // namespace keyline::sketch
