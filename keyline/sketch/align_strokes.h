#pragma once

#include <cstddef>
#include <vector>

#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {

/// Where a stroke runs along a line: for every sample of the stroke the sample of the line beside
/// it. The order along the stroke decides, not place alone, so that lines may wind and cross
/// themselves.
struct Alignment {
  static constexpr int kBefore = -1;  ///< the stroke has not reached the line's start yet
  static constexpr int kAfter = -2;   ///< it has run past the line's end
  std::vector<int> at;                ///< by sample of the stroke, in the stroke's (turned) order
  bool reversed = false;              ///< the stroke runs against the line
  double cost = 0;                    ///< sum over the samples
};

/// The alignment of least sum of squared distances, directions that differ by a right angle costing
/// `reach` squared, samples before or after the line the square of two reaches, ones far off beside
/// it twice that at most: a stroke that leaves the line is not better laid against it, and one
/// that goes on where the line ends is laid after it.
/// Samples of the line are visited in order, at most three on per sample of the stroke. A closed
/// line may be run round again and again.
/// Time and memory: the product of both numbers of samples.
Alignment align(const SampledStroke& stroke, const SampledStroke& line, double reach);

}  // namespace keyline::sketch
