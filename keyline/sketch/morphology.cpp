#include "keyline/sketch/morphology.h"

#include <array>
#include <bit>
#include <vector>

namespace keyline::sketch {
namespace {

constexpr unsigned kBeside = 0b01010101;  ///< the four neighbours that share an edge

/// A bump on a flat base, or a single pixel: at most one neighbour shares an edge, and then both
/// diagonals beside that neighbour are set too and nothing else is.
bool is_bump(unsigned n) {
  if (n == 0) return true;
  if (std::popcount(n) != 3) return false;
  for (unsigned k = 0; k < 8; k += 2) {
    const unsigned base = (1U << k) | (1U << ((k + 1) % 8)) | (1U << ((k + 7) % 8));
    if (n == base) return true;
  }
  return false;
}

/// The same with one pixel of the bump beside it: a bump two pixels long.
bool is_long_bump(unsigned n) {
  if (std::popcount(n) != 4) return false;
  for (unsigned k = 0; k < 8; k += 2) {
    const unsigned base = (1U << k) | (1U << ((k + 1) % 8)) | (1U << ((k + 7) % 8));
    if ((n & base) != base) continue;
    const unsigned rest = n & ~base;
    if (rest == (1U << ((k + 2) % 8)) || rest == (1U << ((k + 6) % 8))) return true;
  }
  return false;
}

/// Of a two pixel bump both pixels must look so: seen from either its mate is the only ink beside.
struct Rules {
  std::array<bool, 256> bump{};
  std::array<bool, 256> long_bump{};
  Rules() {
    for (unsigned n = 0; n < 256; ++n) {
      bump[n] = is_bump(n);
      long_bump[n] = is_long_bump(n) && std::popcount(n & kBeside) == 2;
    }
  }
};

/// Flips pixels of the given colour that are features; `value` 1: bumps of ink, 0: dents. Returns
/// how many.
long flip_features(Binary& ink, std::uint8_t value) {
  static const Rules kRules;
  std::vector<std::size_t> flips;
  const unsigned invert = value ? 0U : 255U;
  const auto seen = [&](int x, int y) { return (neighbours_of(ink, x, y) ^ invert) & 255U; };
  for (int y = 1; y + 1 < ink.height; ++y)
    for (int x = 1; x + 1 < ink.width; ++x) {
      if (ink.at(x, y) != value) continue;
      if (ink.at(x - 1, y) == value && ink.at(x + 1, y) == value && ink.at(x, y - 1) == value &&
          ink.at(x, y + 1) == value)
        continue;
      const unsigned n = seen(x, y);
      bool flip = kRules.bump[n];
      if (!flip && kRules.long_bump[n]) {
        for (const auto& [dx, dy] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
          flip =
              flip || (ink.at(x + dx, y + dy) == value && kRules.long_bump[seen(x + dx, y + dy)]);
      }
      if (flip) flips.push_back(ink.index(x, y));
    }
  for (const std::size_t i : flips) ink.data[i] = static_cast<std::uint8_t>(1 - value);
  return static_cast<long>(flips.size());
}

/// Sets every pixel beside which one of the given value lies to that value.
void grow(Binary& ink, std::uint8_t value) {
  std::vector<std::size_t> flips;
  for (int y = 0; y < ink.height; ++y)
    for (int x = 0; x < ink.width; ++x) {
      if (ink.at(x, y) == value) continue;
      const auto is = [&](int u, int v) {
        return ink.contains(u, v) ? ink.at(u, v) == value : value == 0;
      };
      if (is(x - 1, y) || is(x + 1, y) || is(x, y - 1) || is(x, y + 1))
        flips.push_back(ink.index(x, y));
    }
  for (const std::size_t i : flips) ink.data[i] = value;
}

constexpr std::uint8_t kSeen = 2;

/// Marks the piece around `start` as seen. Its pixels are collected up to `most`; the front of the
/// search is all that is held of larger pieces. Returns whether it touches the rim.
bool collect(Binary& ink, std::size_t start, bool diagonal, std::size_t most,
             std::vector<std::size_t>& piece, std::vector<std::size_t>& front) {
  const std::uint8_t value = ink.data[start];
  const auto w = static_cast<std::size_t>(ink.width);
  piece.assign(1, start);
  front.assign(1, start);
  ink.data[start] |= kSeen;
  bool rim = false;
  while (!front.empty()) {
    const int x = static_cast<int>(front.back() % w);
    const int y = static_cast<int>(front.back() / w);
    front.pop_back();
    rim = rim || x == 0 || y == 0 || x + 1 == ink.width || y + 1 == ink.height;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if ((!diagonal && dx != 0 && dy != 0) || !ink.contains(x + dx, y + dy)) continue;
        const std::size_t j = ink.index(x + dx, y + dy);
        if (ink.data[j] != value) continue;
        ink.data[j] |= kSeen;
        front.push_back(j);
        if (piece.size() < most) piece.push_back(j);
      }
  }
  return rim;
}

/// Flips connected pieces of `value` of fewer than `least` pixels. Pieces of paper that touch the
/// rim are no holes.
int flip_small(Binary& ink, std::uint8_t value, int least, bool diagonal) {
  if (least <= 1) return 0;
  std::vector<std::size_t> piece;
  std::vector<std::size_t> front;
  int flipped = 0;
  for (std::size_t start = 0; start < ink.data.size(); ++start) {
    if (ink.data[start] != value) continue;
    const bool rim = collect(ink, start, diagonal, static_cast<std::size_t>(least), piece, front);
    if (piece.size() >= static_cast<std::size_t>(least) || (value == 0 && rim)) continue;
    for (const std::size_t i : piece) ink.data[i] = static_cast<std::uint8_t>((1 - value) | kSeen);
    ++flipped;
  }
  for (std::uint8_t& v : ink.data) v &= 1;
  return flipped;
}

}  // namespace

void erode(Binary& ink) { grow(ink, 0); }
void dilate(Binary& ink) { grow(ink, 1); }

void smooth_pixels(Binary& ink, int times) {
  for (int i = 0; i < times; ++i) erode(ink);
  for (int i = 0; i < 2 * times; ++i) dilate(ink);
  for (int i = 0; i < times; ++i) erode(ink);
}

long smooth_edges(Binary& ink, int times) {
  long changed = 0;
  for (int i = 0; i < times; ++i) changed += flip_features(ink, 1) + flip_features(ink, 0);
  return changed;
}

Removed remove_specks(Binary& ink, int specks, int pinholes) {
  Removed removed;
  removed.pinholes = flip_small(ink, 0, pinholes, false);
  removed.specks = flip_small(ink, 1, specks, true);
  return removed;
}

}  // namespace keyline::sketch
