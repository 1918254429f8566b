#pragma once

#include <algorithm>
#include <cstddef>

#include "keyline/numeric/parallel.h"

namespace keyline::sketch {

constexpr int kRowsAtOnce = 32;

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

/// Every value of `from` looked up in a table, into `to` of the same size, which may be `from`.
template <class Pixels, class Table>
void look_up(const Pixels& from, const Table& table, Pixels& to) {
  for_rows(0, from.height, [&](int first, int last) {
    const std::size_t end = from.index(0, last);
    for (std::size_t i = from.index(0, first); i < end; ++i) to.data[i] = table[from.data[i]];
  });
}

}  // namespace keyline::sketch
