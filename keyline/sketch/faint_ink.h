#pragma once

#include <cstddef>
#include <cstdint>

#include "keyline/sketch/thinning.h"
#include "keyline/sketch/tone.h"

namespace keyline::sketch {

/// Pixels seen to be darker than paper that are no ink: what is too faint beside or below darker
/// ink, and the soft border of broad lines. A bit each; rows may be written to at the same time.
class FaintPixels {
 public:
  FaintPixels() = default;
  FaintPixels(int width, int height) : width_(width), bits_((width + 7) / 8, height) {}

  bool contains(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < bits_.height; }
  bool at(int x, int y) const { return (bits_.at(x / 8, y) >> (x % 8) & 1) != 0; }
  void set(int x, int y) { bits_.at(x / 8, y) |= static_cast<std::uint8_t>(1 << (x % 8)); }
  void clear(int x, int y) { bits_.at(x / 8, y) &= static_cast<std::uint8_t>(~(1 << (x % 8))); }

  int height() const { return bits_.height; }
  /// Calls see(x) for every pixel of a row that is set; it may clear that one.
  template <class See>
  void visit(int y, const See& see) const {
    for (int b = 0; b < bits_.width; ++b) {
      if (bits_.at(b, y) == 0) continue;
      for (int x = 8 * b; x < 8 * b + 8; ++x)
        if (at(x, y)) see(x);
    }
  }

 private:
  int width_ = 0;
  Raster<std::uint8_t> bits_;
};

/// What tells a faint line from shade and grain.
struct FaintLine {
  double reach = 3;     ///< pixels from all ink, beyond the soft border of its lines
  int specks = 12;      ///< pixels of a piece (8-connected) at least
  double broadest = 8;  ///< pixels
};

/// How many faint pixels are ink of their own that was lost: farther than `reach` from all ink, in
/// pieces as large, twice as dark as what lies beside them on both sides (medians); where shade
/// fades, it is as dark beside it. The faint pixels are spent, `ink` stays as it is.
std::size_t count_lost(FaintPixels& faint, Binary& ink, const Tone& tone, const FaintLine& wanted);

/// Makes ink of the faint pixels that are lines of their own: such pieces, twice as dark as what
/// lies beside them, so many pixels away on both sides (medians). How many; what else lies so far
/// from ink stays faint, in pieces as large.
std::size_t ink_lines(FaintPixels& faint, Binary& ink, const Tone& tone, const FaintLine& wanted);

/// Takes out the pieces of ink that are the edge of shade: not twice as dark as what lies beside
/// them, so many pixels away on both sides (medians). How many pixels.
std::size_t drop_shade(Binary& ink, const Tone& tone, double broadest);

}  // namespace keyline::sketch
