#include "keyline/sketch/dark_rows.h"

#include <algorithm>
#include <cmath>

#include "keyline/sketch/rows.h"

namespace keyline::sketch {
namespace {

/// Index mirrored in the first and the last of n.
int mirrored(int i, int n) {
  if (n == 1) return 0;
  return i < 0 ? -i : i >= n ? 2 * (n - 1) - i : i;
}

}  // namespace

DarknessTable::DarknessTable(const Tone& tone)
    : table_(level_table<std::uint16_t>([&](double level) {
        return static_cast<std::uint16_t>(
            std::lround(kBlack * darkness_of(level / Tone::kWhite, tone.gain)));
      })) {}

int DarknessTable::highest_level(int darkness) const {
  const auto lighter = std::ranges::partition_point(table_, [&](int d) { return d >= darkness; });
  return static_cast<int>(lighter - table_.begin()) - 1;
}

DarkRows::DarkRows(const Raster<std::uint16_t>& level, const DarknessTable& table, double sigma,
                   int least)
    : level_(level),
      table_(table),
      lighter_(static_cast<std::uint16_t>(table.highest_level(least) + 1)),
      stride_(static_cast<std::size_t>(level.width + 2 * kMargin)),
      blocks_(static_cast<std::size_t>((level.width + kBlock - 1) / kBlock)) {
  const double beside = std::exp(-0.5 / (sigma * sigma));
  side_ = static_cast<std::uint32_t>(std::lround(65536 * beside / (1 + 2 * beside)));
}

int DarkRows::end_of(std::size_t block) const {
  return std::min((static_cast<int>(block) + 1) * kBlock, level_.width);
}

/// Marks the blocks of a row in which something is seen.
void DarkRows::look(int y) {
  std::uint8_t* seen = &seen_[static_cast<std::size_t>(y - top_ + 1) * blocks_];
  const std::uint16_t* row = &level_.data[level_.index(0, y)];
  const auto width = static_cast<std::size_t>(level_.width);
  for (std::size_t b = 0; b < blocks_; ++b) {
    std::uint16_t any = 0;  // as wide as the pixels: the loop has no branches then
    if ((b + 1) * kBlock <= width) {
      for (std::size_t k = 0; k < kBlock; ++k)
        any |= static_cast<std::uint16_t>(row[b * kBlock + k] < lighter_);
    } else {
      for (std::size_t x = b * kBlock; x < width; ++x) any |= row[x] < lighter_ ? 1 : 0;
    }
    seen[b] = static_cast<std::uint8_t>(any);
  }
}

/// Marks the blocks of a row around which something is seen.
void DarkRows::spread(int y) {
  std::uint8_t* near = &near_[static_cast<std::size_t>(y - top_) * blocks_];
  const std::uint8_t* seen = &seen_[static_cast<std::size_t>(y - top_) * blocks_];
  for (std::size_t b = 0; b < blocks_; ++b) {
    const std::uint8_t any = seen[b] | seen[b + blocks_] | seen[b + 2 * blocks_];
    near[b] |= any;
    if (b > 0) near[b - 1] |= any;
    if (b + 1 < blocks_) near[b + 1] |= any;
  }
}

void DarkRows::blur_along(int y, int x0, std::array<std::uint32_t, kBlock>& blurred) const {
  const std::uint16_t* row = &level_.data[level_.index(0, mirrored(y, level_.height))];
  std::array<std::uint32_t, kBlock + 2> dark;
  if (x0 > 0 && x0 + kBlock < level_.width) {
    for (std::size_t k = 0; k < dark.size(); ++k)
      dark[k] = table_[row[static_cast<std::size_t>(x0) + k - 1]];
  } else {
    for (std::size_t k = 0; k < dark.size(); ++k) {
      const int x = mirrored(std::min(x0 + static_cast<int>(k) - 1, level_.width), level_.width);
      dark[k] = table_[row[x]];
    }
  }
  const std::uint32_t middle = 65536 - 2 * side_;
  for (std::size_t k = 0; k < kBlock; ++k)
    blurred[k] = side_ * (dark[k] + dark[k + 2]) + middle * dark[k + 1];
}

void DarkRows::blur(int y, std::size_t block) {
  const int x0 = static_cast<int>(block) * kBlock;
  std::array<std::array<std::uint32_t, kBlock>, 3> along;
  for (int r = 0; r < 3; ++r) blur_along(y + r - 1, x0, along[static_cast<std::size_t>(r)]);
  const std::uint64_t side = side_;
  const std::uint64_t middle = 65536 - 2 * side;
  std::uint16_t* to = rows_.data() + offset(y) + x0;
  const auto count = static_cast<std::size_t>(end_of(block) - x0);
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint64_t sides = std::uint64_t{along[0][k]} + along[2][k];
    to[k] = static_cast<std::uint16_t>((side * sides + middle * along[1][k] + (1ULL << 31)) >> 32);
  }
}

void DarkRows::read(int first, int last) {
  top_ = first - kMargin;
  const int bottom = last + kMargin;
  const auto count = static_cast<std::size_t>(bottom - top_);
  rows_.assign(count * stride_, 0);
  seen_.assign((count + 2) * blocks_, 0);
  near_.assign(count * blocks_, 0);
  for (int y = std::max(0, top_ - 1); y < std::min(level_.height, bottom + 1); ++y) look(y);
  for (int y = std::max(0, top_); y < std::min(level_.height, bottom); ++y) {
    spread(y);
    for (std::size_t b = 0; b < blocks_; ++b)
      if (near(y)[b]) blur(y, b);
  }
}

}  // namespace keyline::sketch
