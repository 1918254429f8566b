#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace keyline::sketch {

/// Eight pixels of a binary picture, or four of grey, as one word. Precondition: they are there.
template <class Pixel>
std::uint64_t word_at(const Pixel* row) {
  std::uint64_t word = 0;
  std::memcpy(&word, row, sizeof word);
  return word;
}

/// Calls see(i) for the values of a row of n that are not 0, in order.
template <class Pixel, class See>
void visit_set(const Pixel* row, std::size_t n, const See& see) {
  constexpr std::size_t kWord = sizeof(std::uint64_t) / sizeof(Pixel);
  std::size_t i = 0;
  for (; i + kWord <= n; i += kWord) {
    if (word_at(row + i) == 0) continue;
    for (std::size_t k = i; k < i + kWord; ++k)
      if (row[k]) see(k);
  }
  for (; i < n; ++i)
    if (row[i]) see(i);
}

/// How many of the eight pixels of a word, each 0 or 1, are ink.
inline int ink_of_word(std::uint64_t word) {
  return static_cast<int>((word * 0x0101010101010101) >> 56);
}

/// How many of n pixels, each 0 or 1, are ink.
inline std::int64_t count_ink(const std::uint8_t* row, std::size_t n) {
  std::int64_t count = 0;
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) count += ink_of_word(word_at(row + i));
  for (; i < n; ++i) count += row[i];
  return count;
}

}  // namespace keyline::sketch
