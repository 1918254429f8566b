#pragma once

#include <vector>

#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {

/// How a line goes over from one stroke to another.
struct Going {
  double calm = 1;   ///< length of the waves that moving may make
  double angle = 1;  ///< radians to the strokes, where they lie too far apart to be kept to both
};

/// A line moved sideways, as little and as calmly as it takes, until all of it lies within `most`
/// of a stroke that runs along it: where strokes lie far apart it goes with one of them rather than
/// through the paper between, and changes from one to another where they come nearest. Parts that
/// no stroke runs along stay. `reach`: how far from the line strokes run along it.
std::vector<core::Point2> hold_to_strokes(const SampledStroke& line,
                                          const std::vector<SampledStroke>& strokes, double most,
                                          double reach, const Going& going);

/// Share of a line's length farther than `most` from all strokes.
double share_off(const std::vector<core::Point2>& points, bool closed,
                 const std::vector<SampledStroke>& strokes, double most);

}  // namespace keyline::sketch
