#pragma once

#include <array>
#include <cstdint>

#include "keyline/sketch/image.h"

namespace keyline::sketch {

/// What a scanner leaves dark around the paper, by side: how far it reaches into the picture at
/// most, in pixels; 0 where there is none.
struct Margins {
  std::array<int, 4> deepest{};  ///< left, top, right, bottom
  double share = 0;              ///< of the picture

  bool any() const { return share > 0; }
};

/// Dark margins become as light as the paper beside them.
///
/// A margin is what is darker than half of the paper from a side of the picture inwards, along an
/// eighth of that side and more, and holds a corner of the picture: a line that leaves the picture
/// crosses its rim in a short stretch, and one that a close cut touches keeps clear of the corners.
/// A margin ends where it is no longer an eighth of the side long; a line that runs into it stays.
/// A picture of which margins would take more than half is left as it is.
/// Dark lines on light paper are expected, paper of the given luminance.
/// Cost: linear in the margins and the picture's rim.
Margins clear_margins(Raster<std::uint16_t>& luminance, double paper);

}  // namespace keyline::sketch
