#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "keyline/numeric/parallel.h"
#include "keyline/sketch/pixel_words.h"

namespace keyline::sketch {

constexpr int kRowsAtOnce = 32;  ///< in a band: enough work for a thread, little to wait for

/// Calls body(first, last) for bands of rows that together are [from, to), on all of the machine's
/// threads. The bands are the same whatever their number: see numeric::parallel_for.
template <class Body>
void for_rows(int from, int to, Body&& body) {
  if (from >= to) return;
  const int bands = (to - from + kRowsAtOnce - 1) / kRowsAtOnce;
  numeric::parallel_for(static_cast<std::size_t>(bands), 0, [&](std::size_t k) {
    const int first = from + static_cast<int>(k) * kRowsAtOnce;
    body(first, std::min(first + kRowsAtOnce, to));
  });
}

/// What a function makes of every level that a pixel may have, on all of the machine's threads.
template <class T, class Of>
std::vector<T> level_table(Of&& of) {
  constexpr std::size_t kLevels = 65536;  // of 16 bits
  constexpr std::size_t kAtOnce = 4096;   // by one thread
  std::vector<T> table(kLevels);
  numeric::parallel_for(kLevels / kAtOnce, 0, [&](std::size_t k) {
    for (std::size_t i = k * kAtOnce; i < (k + 1) * kAtOnce; ++i)
      table[i] = of(static_cast<double>(i));
  });
  return table;
}

/// Values of a row looked up in a table. Paper is of one level for long stretches: four pixels at
/// once that are as the four before cost a comparison.
template <class Table>
void look_up_row(const std::uint16_t* from, std::size_t n, const Table& table, std::uint16_t* to) {
  std::uint64_t last = 0;
  std::array<std::uint16_t, 4> found{table[0], table[0], table[0], table[0]};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    const std::uint64_t word = word_at(from + i);
    if (word != last) {
      for (std::size_t k = 0; k < 4; ++k) found[k] = table[from[i + k]];
      last = word;
    }
    std::memcpy(to + i, found.data(), sizeof found);
  }
  for (; i < n; ++i) to[i] = table[from[i]];
}

/// Every value of `from` looked up in a table, into `to` of the same size, which may be `from`.
template <class Pixels, class Table>
void look_up(const Pixels& from, const Table& table, Pixels& to) {
  for_rows(0, from.height, [&](int first, int last) {
    const std::size_t begin = from.index(0, first);
    look_up_row(from.data.data() + begin, from.index(0, last) - begin, table,
                to.data.data() + begin);
  });
}

}  // namespace keyline::sketch
