#pragma once

#include "keyline/sketch/image.h"
#include "keyline/sketch/trace.h"

namespace keyline::sketch {

/// How many times a picture was enlarged by repeating its pixels: the largest whole number by whose
/// multiples alone rows and columns change. 1 where it was not, or holds one level only.
int enlargement(const Image& image);

/// Every `times`-th pixel of every `times`-th row.
Image reduced(const Image& image, int times);

/// The trace of a reduced picture in the pixels of the enlarged one.
void enlarge(TraceResult& trace, int times);

}  // namespace keyline::sketch
