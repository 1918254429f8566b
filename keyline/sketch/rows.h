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

}  // namespace keyline::sketch
