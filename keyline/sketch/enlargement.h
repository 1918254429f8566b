#pragma once

#include "keyline/sketch/image.h"
#include "keyline/sketch/trace.h"

namespace keyline::sketch {

/// The size a picture had before its pixels were repeated (enlarged without interpolating, by any
/// factor from 1.5 to 16, and perhaps compressed since); its own where they were not.
struct OwnSize {
  int width = 0;
  int height = 0;
  double shift = 0;  ///< of a pixel's place when it was repeated, in repeated pixels
  friend bool operator==(const OwnSize&, const OwnSize&) = default;
};

/// Repeated pixels change only where one ends: by how much more of the squares of the differences
/// between neighbouring columns (rows) lies there than by chance, from 0 to 1, the factor is told;
/// 0.8 is asked for, both ways, of so many steps that chance makes it once in a million. Drawings
/// that were not enlarged so have below 0.2, those that were and went through JPEG since above 0.9.
OwnSize own_size(const Image& image);

/// The picture at its own size: the mean of each pixel's repeats.
Image reduced(const Image& image, const OwnSize& size);

/// The trace of a reduced picture in the pixels of the enlarged one.
void enlarge(TraceResult& trace, int to_width, int to_height);

}  // namespace keyline::sketch
