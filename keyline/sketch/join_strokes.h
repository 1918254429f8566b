#pragma once

#include <cstdint>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/sketch/stroke_graph.h"

namespace keyline::sketch {

/// A line as a hand drew it: through junctions, over gaps. Pixels, y down.
struct RawStroke {
  std::vector<core::Point2> points;  ///< about a pixel apart
  std::vector<float> radii;          ///< half the ink's width
  /// 0 where the place is a guess: in junctions and gaps; 2 on the ink of a knot, where other lines
  /// may run into it.
  std::vector<std::uint8_t> sure;
  bool closed = false;
  bool free_start = false;  ///< ends in paper, not at another line
  bool free_end = false;
};

struct JoinOptions {
  double gap = 8;      ///< longest gap in the ink that is bridged, in pixels
  bool rows = true;    ///< longer ones too, in a row of dashes
  double turn = 1.05;  ///< radians: lines that turn more at a junction are two
};

/// Junctions resolved: of the lines that meet, those are joined that go on straightest (least sum
/// of turns over all ways to pair them, a line left over counting half `turn`). Junctions closer to
/// each other than the lines are wide are one, and so are the two ends of the stretch that lines
/// crossing at a small angle share. Free ends that face each other over at most `gap` are joined,
/// and dashes and dots in a row (bridge_gaps.h, dot_rows.h).
std::vector<RawStroke> join_strokes(StrokeGraph graph, const JoinOptions& options);

}  // namespace keyline::sketch
