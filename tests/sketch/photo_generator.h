#pragma once

#include <cstdint>
#include <vector>

#include "keyline/sketch/image.h"
#include "keyline/sketch/sheet.h"

#include "drawing_generator.h"

/// Photos of a sheet of paper whose place, and the lines on which, are known: the same seed gives
/// the same photo everywhere.
namespace keyline::sketch::testing {

struct TruePhoto {
  std::vector<TrueStroke> strokes;  ///< on the sheet, half a unit apart, y up
  double width = 0;                 ///< of the sheet in those units
  double height = 0;
  SheetCorners corners;  ///< of the sheet in the photo
  Image image;
};

/// Six arcs, each for itself, on a sheet that lies on a darker grained table, seen by a camera
/// without distortion, of 0.6 to 1.2 diagonals of focal length, that looks at it up to `tilt`
/// radians aslant and turned by a quarter of that at most; a shadow with a soft rim lies across
/// both.
TruePhoto make_photo(std::uint64_t seed, double tilt);

}  // namespace keyline::sketch::testing
