#pragma once

#include <vector>

#include "keyline/sketch/refine_stroke.h"
#include "keyline/sketch/thinning.h"
#include "keyline/sketch/tone.h"

namespace keyline::sketch {

/// Where the Laplacian of a binary picture is not zero on ink: the edge pixels of [Sketch] 3.4.
Binary laplacian_edges(const Binary& ink);

/// The outer borders of the pieces of ink as closed strokes, a pixel between points; contours
/// inside are left out, as in [Sketch] section 3.4. Borders lie where the grey values pass half of
/// the ink's darkness, not on pixels. Strokes have no width.
std::vector<FineStroke> outlines(const Binary& ink, const Tone& tone);

}  // namespace keyline::sketch
