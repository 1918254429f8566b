#pragma once

#include "keyline/sketch/thinning.h"

namespace keyline::sketch {

/// What the ink's area and border tell of its lines.
struct InkMeasure {
  double width = 1;   ///< usual width of the lines: twice the ink over its border
  double border = 0;  ///< pixels of ink beside paper
};

InkMeasure measure_ink(const Binary& ink);

/// True for what is too broad in a picture of that size to be a line: an area.
constexpr bool is_broad(double line, int width, int height) {
  return line > 0.06 * (width > height ? width : height);
}

}  // namespace keyline::sketch
