#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"

namespace keyline::exchange {

/// A pen stroke of a .scap file, as drawing studies record them.
struct ScapStroke {
  int id = 0;
  int group = 0;  ///< strokes of one number stand for one line
  std::vector<core::Point2> points;
};

struct ScapDrawing {
  double width = 0;  ///< of the canvas
  double height = 0;
  double pen = 1;                          ///< width of the pen
  std::vector<ScapStroke> strokes;         ///< y as in the file, downwards; each has a point
  std::vector<std::string> left_out = {};  ///< strokes without points, with their lines
};

/// A stroke's points with y upwards, from the canvas's lower side.
std::vector<core::Point2> upright(const ScapDrawing& drawing, const ScapStroke& stroke);

/// Reads "#width height", "@pen" and blocks { #id group, x y … }; what stands behind the blocks in
/// lines that start with # is skipped.
/// Fails: bad_input with "line N" for anything else, numbers that are not finite, rows of more or
/// fewer numbers than their stroke's first, numbers of strokes and groups that are not whole or
/// given twice, a stroke that does not end, or no stroke.
core::Result<ScapDrawing> read_scap(std::string_view text);

}  // namespace keyline::exchange
