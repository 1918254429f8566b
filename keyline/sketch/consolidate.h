#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/point.h"

/// Designers draw a line several times over; here the one line they meant comes out.
namespace keyline::sketch {

/// A stroke as it was drawn: at least two points.
struct DrawnStroke {
  std::vector<core::Point2> points;
  bool closed = false;
};

struct ConsolidateOptions {
  double width = 1;  ///< of the pen, in the strokes' unit
  double reach = 0;  ///< farthest apart strokes of one line lie; 0: by width and length of strokes
  double angle = 0.4;  ///< radians: strokes that differ more in direction are different lines
};

/// The line that a group of strokes stands for.
struct MeantLine {
  std::vector<core::Point2> points;  ///< half a reach apart or closer
  bool closed = false;
  std::vector<std::size_t> members;  ///< indices of the strokes
};

/// Groups strokes that run beside each other or go on from one another, and gives every group the
/// line along its middle.
///
/// Two strokes belong together if one runs along the other (within reach, direction within angle)
/// for most of its length, or if an end of one runs along an end of the other, so that they go on
/// from each other. The line of a group is that of meant_line; strokes alone stay as they
/// are but for repeated points.
/// Order: lines by their first member. Throws InvalidInput for a stroke of fewer than two points.
std::vector<MeantLine> consolidate(const std::vector<DrawnStroke>& strokes,
                                   const ConsolidateOptions& options = {});

}  // namespace keyline::sketch
