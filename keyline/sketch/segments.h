#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/sketch/polyline_tools.h"

namespace keyline::sketch {

struct SegmentOptions {
  double straightness = 0.75;  ///< largest distance of a group's points from its axis, pixels
  double corner_angle = 0.6;   ///< radians: a sharper turn in one place is a corner
  double width = 2;            ///< of the stroke: what a corner is rounded over
  /// From a place beside or on a line to where its ink ends that way (unit), the ink within `near`;
  /// nothing where it does not end, as where another line goes on. Empty: there is no ink to ask.
  std::function<std::optional<double>(core::Point2 from, core::Vector2 out, double near)> ink = {};
};

/// The stretch between two corners (or ends), or a closed line without corners.
struct SegmentRun {
  std::size_t first = 0;  ///< indices of its points; a run over the seam of a closed stroke has
  std::size_t last = 0;   ///< last beyond the number of points
  bool closed = false;
  double round_first = 0;  ///< how far from a corner at its first point the ink rounds the line
  double round_last = 0;
  std::vector<Axis> axes;  ///< one per group of points
  std::vector<core::Point2>
      vertices;  ///< the concatenated line segments; closed: first not repeated
};

/// Indices of points where the line turns sharply.
std::vector<std::size_t> find_corners(const std::vector<core::Point2>& points, bool closed,
                                      const SegmentOptions& options);

/// Concatenated line segments along ordered points ([Sketch] section 4).
///
/// Between corners the points are put into groups by Sturges' rule (1 + log2 n groups of equal
/// size); a group that is not straight is halved until it is. Each group's principal axis is a line
/// segment; neighbours meet where their axes intersect, or, where these are nearly parallel or
/// would meet far off, halfway between the axes. Corners are where the axes on both sides meet.
std::vector<SegmentRun> fit_segments(const std::vector<core::Point2>& points, bool closed,
                                     const SegmentOptions& options);

}  // namespace keyline::sketch
