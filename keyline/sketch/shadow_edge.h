#pragma once

#include <cstdint>
#include <vector>

#include "keyline/sketch/image.h"

namespace keyline::sketch {

/// A box of the picture across which the paper steps, with its levels made flat.
struct SteppedBox {
  int x = 0;
  int y = 0;
  Raster<std::uint16_t> flat;
};

/// Paper at the hard edges of shadows, which blocks are too coarse for. Where the paper of blocks
/// (`paper`, with `rim` blocks more on every side) differs by more than a tenth of its light within
/// two blocks, it is the median of the pixels about each place, which follows an edge and leaves
/// lines out, as far as that lies between the darkest and the lightest of those blocks. `gain` is
/// the a of y = a·log x.
std::vector<SteppedBox> flat_at_steps(const Raster<std::uint16_t>& level,
                                      const Raster<float>& paper, int rim, double gain);

}  // namespace keyline::sketch
