#pragma once

#include <array>
#include <optional>

#include "keyline/core/point.h"
#include "keyline/sketch/image.h"

namespace keyline::sketch {

/// Corners of a sheet of paper in a photo, in its pixels with y down: the one that is upper left
/// when the sheet is turned the least, then upper right, lower right, lower left.
using SheetCorners = std::array<core::Point2, 4>;

struct Sheet {
  SheetCorners corners;
  double bend = 0;  ///< root mean square distance of the paper's border from straight sides, pixels
};

/// The sheet of light paper on a darker ground that a photo shows; empty where there is none, as in
/// a scan, whose paper fills the picture, or on a ground as light as the paper.
///
/// Four straight sides, each of which for the most part has paper inside and something darker
/// outside, all the way to the picture's rim; a tenth of the picture and more. Lines and frames
/// that are drawn do not count: beyond them there is paper again. The corners may lie a little
/// outside of the picture.
/// Cost: linear in the pixels, a few passes over a picture reduced to some 500 pixels.
std::optional<Sheet> find_sheet(const Image& image);

}  // namespace keyline::sketch
