#pragma once

#include <vector>

#include "keyline/sketch/refine_stroke.h"
#include "keyline/sketch/stroke_curve.h"
#include "keyline/sketch/thinning.h"

namespace keyline::sketch {

/// Share of the ink that lies within half the line's width and a pixel of a curve, 1 without ink.
/// Strokes in pixels, y down. The picture is spent: what is explained is taken out of it.
double explained_ink(Binary& ink, const std::vector<Stroke>& strokes);

/// The same of strokes as they were read from the picture, before curves were drawn.
double explained_ink(Binary& ink, const std::vector<FineStroke>& strokes);

}  // namespace keyline::sketch
