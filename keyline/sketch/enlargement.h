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

/// In an enlarged picture columns (rows) differ only where a repeated pixel ends. The factor is
/// found by how much more of the squared differences lies there than by chance, on a scale from 0
/// to 1: at least 0.8, in both directions, over so many steps that chance does it once in a
/// million. Drawings that were not enlarged stay below 0.2, enlarged ones after JPEG lie above 0.9.
OwnSize own_size(const Image& image);

/// The picture at its own size: the mean of each pixel's repeats.
Image reduced(const Image& image, const OwnSize& size);

/// The trace of a reduced picture in the pixels of the enlarged one.
void enlarge(TraceResult& trace, int to_width, int to_height);

}  // namespace keyline::sketch
