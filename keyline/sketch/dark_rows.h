#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "keyline/sketch/tone.h"

namespace keyline::sketch {

constexpr double kBlack = 65535;  ///< darkness of black; paper has 0

/// Darkness of the levels of a tone: with it the grey of a pixel half covered by ink lies halfway.
/// It falls as the level rises.
class DarknessTable {
 public:
  explicit DarknessTable(const Tone& tone);

  std::uint16_t operator[](std::size_t level) const { return table_[level]; }

  /// The highest level that is at least so dark; -1 where none is.
  int highest_level(int darkness) const;

 private:
  std::vector<std::uint16_t> table_;
};

/// Darkness of rows of a picture, blurred by 3 × 3 pixels, where it can come to `least`; elsewhere
/// 0. So little is ink that most places cost a comparison of their level.
class DarkRows {
 public:
  /// Rows and columns that can be asked for around a band; beyond the picture they are 0.
  static constexpr int kMargin = 3;

  /// `sigma` of the blur in pixels. Both pictures have to stay.
  DarkRows(const Raster<std::uint16_t>& level, const DarknessTable& table, double sigma, int least);

  /// Takes rows [first, last) and their margin.
  void read(int first, int last);

  /// The first pixel of a row that was read; kMargin are there on either side of it and its end.
  const std::uint16_t* row(int y) const { return rows_.data() + offset(y); }
  /// To the same pixel of the next row.
  std::ptrdiff_t stride() const { return static_cast<std::ptrdiff_t>(stride_); }

  /// Calls see(x) for pixels of a row that was read where darkness can be `least`, in order.
  template <class See>
  void visit(int y, const See& see) const {
    for (std::size_t b = 0; b < blocks_; ++b) {
      if (!near(y)[b]) continue;
      const int end = end_of(b);
      for (int x = static_cast<int>(b) * kBlock; x < end; ++x) see(x);
    }
  }

 private:
  static constexpr int kBlock = 16;  ///< pixels that are looked at together

  std::size_t offset(int y) const { return static_cast<std::size_t>(y - top_) * stride_ + kMargin; }
  int end_of(std::size_t block) const;
  const std::uint8_t* near(int y) const {
    return near_.data() + static_cast<std::size_t>(y - top_) * blocks_;
  }
  void look(int y);
  void spread(int y);
  void blur(int y, std::size_t block);
  /// Darkness of a block and one pixel on either side, blurred along the row.
  void blur_along(int y, int x0, std::array<std::uint32_t, kBlock>& blurred) const;

  const Raster<std::uint16_t>& level_;
  const DarknessTable& table_;
  std::uint32_t side_ = 0;     ///< weight of a neighbour of 65536
  std::uint16_t lighter_ = 0;  ///< level from which on nothing is seen
  std::size_t stride_ = 0;
  std::size_t blocks_ = 0;  ///< of a row
  int top_ = 0;             ///< first row that was read, with its margin
  std::vector<std::uint16_t> rows_;
  std::vector<std::uint8_t> seen_;  ///< blocks with a pixel so dark, from the row before `top_`
  std::vector<std::uint8_t> near_;  ///< those and the blocks around them, from `top_`
};

}  // namespace keyline::sketch
