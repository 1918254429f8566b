#pragma once

#include <cstdint>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/sketch/image.h"

/// Drawings whose lines are known: the same seed gives the same drawing everywhere.
namespace keyline::sketch::testing {

struct TrueStroke {
  std::vector<core::Point2> points;  ///< half a pixel apart, pixels with y up
  double width = 2;
};

struct TrueDrawing {
  std::vector<TrueStroke> strokes;
  Image image;
};

/// Log-aesthetic and cubic strokes 2 to 12 pixels wide on paper with a gradient, grain, salt and
/// pepper and JPEG blocks. Strokes cross each other at 30 degrees or more, away from ends; ends
/// keep clear of other strokes, and a stroke of itself (where lines touch, no one can say which is
/// which).
TrueDrawing make_drawing(std::uint64_t seed);

}  // namespace keyline::sketch::testing
