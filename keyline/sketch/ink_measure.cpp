#include "keyline/sketch/ink_measure.h"

#include <algorithm>
#include <atomic>

#include "keyline/sketch/pixel_words.h"
#include "keyline/sketch/rows.h"

namespace keyline::sketch {
namespace {

/// Pixels of a row of ink that have ink across all four edges. Precondition: rows on both sides.
long count_inside(const std::uint8_t* row, std::size_t width) {
  const std::uint8_t* above = row - width;
  const std::uint8_t* below = row + width;
  long count = 0;
  std::size_t x = 1;
  for (; x + 9 <= width; x += 8) {
    const std::uint64_t word = word_at(row + x);
    if (word != 0)
      count += ink_of_word(word & word_at(row + x - 1) & word_at(row + x + 1) & word_at(above + x) &
                           word_at(below + x));
  }
  for (; x + 1 < width; ++x) count += row[x] & row[x - 1] & row[x + 1] & above[x] & below[x];
  return count;
}

}  // namespace

InkMeasure measure_ink(const Binary& ink) {
  std::atomic<long> all_area = 0;
  std::atomic<long> all_border = 0;
  for_rows(0, ink.height, [&](int first, int last) {
    const auto width = static_cast<std::size_t>(ink.width);
    long area = 0;
    long inside = 0;
    for (int y = first; y < last; ++y) {
      const std::uint8_t* here = ink.data.data() + ink.index(0, y);
      area += count_ink(here, width);
      if (y > 0 && y + 1 < ink.height) inside += count_inside(here, width);
    }
    all_area += area;
    all_border += area - inside;
  });
  const auto area = static_cast<double>(all_area);
  const auto border = static_cast<double>(all_border);
  return {border > 0 ? std::max(1.0, 2 * area / border) : 1, border};
}

}  // namespace keyline::sketch
