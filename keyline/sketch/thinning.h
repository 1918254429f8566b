#pragma once

#include <cstdint>

#include "keyline/sketch/image.h"

namespace keyline::sketch {

/// Binary pictures hold 1 for ink and 0 for paper.
using Binary = Raster<std::uint8_t>;

/// Thins ink to lines one pixel wide that keep its connections, holes and ends.
///
/// Guo & Hall's parallel thinning ([Guo 1989]) over a list of border
/// pixels, so that the time grows with the ink, not with ink times width; then corners of
/// staircases are taken out until no pixel can go without changing connections.
Binary thin(const Binary& ink);

/// The eight neighbours of a pixel as bits, from the one above clockwise (bit 0: north, bit 1:
/// north-east, …); outside the picture is paper.
unsigned neighbours_of(const Binary& binary, int x, int y);

/// True where taking the middle pixel out of (or putting it into) ink leaves the number of pieces
/// of ink (8-connected) and of paper (4-connected) as they are.
bool is_simple(unsigned neighbours);

}  // namespace keyline::sketch
