#pragma once

#include <cstddef>
#include <vector>

#include "keyline/sketch/image.h"

namespace keyline::sketch {

/// Follows what hangs together from the pixels of `piece` on, of which new ones come to its end.
/// take(x, y): whether a pixel of the picture is of the piece and not in it yet; goes_on(x, y):
/// whether, at one of the piece, its neighbours are still looked at. `diagonal`: those at corners
/// are neighbours too.
template <class Take, class GoesOn>
void follow_piece(const Binary& ink, bool diagonal, std::vector<std::size_t>& piece, Take take,
                  GoesOn goes_on) {
  const auto width = static_cast<std::size_t>(ink.width);
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const int x = static_cast<int>(piece[k] % width);
    const int y = static_cast<int>(piece[k] / width);
    if (!goes_on(x, y)) return;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (!diagonal && dx != 0 && dy != 0) continue;
        if (ink.contains(x + dx, y + dy) && take(x + dx, y + dy))
          piece.push_back(ink.index(x + dx, y + dy));
      }
  }
}

}  // namespace keyline::sketch
