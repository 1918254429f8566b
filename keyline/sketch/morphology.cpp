#include "keyline/sketch/morphology.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "keyline/sketch/dash_row.h"
#include "keyline/sketch/ink_piece.h"
#include "keyline/sketch/pixel_words.h"
#include "keyline/sketch/rows.h"

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

/// Eight pixels and those beside them across edges, 1 where they have the value that is looked for.
struct Around {
  std::uint64_t here, left, right, above, below;
};

/// Calls see(x, y) for pixels inside the rim that have the value and are chosen, of which
/// `choose` makes a word of such pixels, in rows [first, last), none of which is the picture's
/// first or last. What is seen may change the picture if that makes no more pixels be chosen.
template <class Choose, class See>
void visit_chosen(const Binary& ink, int first, int last, std::uint8_t value, const Choose& choose,
                  const See& see) {
  const std::uint64_t other = value ? 0 : 0x0101010101010101;
  for (int y = first; y < last; ++y) {
    const std::uint8_t* above = &ink.at(0, y - 1);
    const std::uint8_t* here = &ink.at(0, y);
    const std::uint8_t* below = &ink.at(0, y + 1);
    const auto word = [other](const std::uint8_t* row) { return word_at(row) ^ other; };
    int x = 1;
    for (; x + 9 <= ink.width; x += 8) {
      if (word(here + x) == 0) continue;
      if (value == 0 && (word_at(here + x - 1) | word_at(here + x + 1) | word_at(above + x) |
                         word_at(below + x)) == 0)
        continue;  // most of the paper
      const Around around{word(here + x), word(here + x - 1), word(here + x + 1), word(above + x),
                          word(below + x)};
      const std::uint64_t chosen = around.here & choose(around);
      if (chosen == 0) continue;
      std::array<std::uint8_t, 8> pixels{};
      std::memcpy(pixels.data(), &chosen, sizeof chosen);
      for (int k = 0; k < 8; ++k)
        if (pixels[static_cast<std::size_t>(k)]) see(x + k, y);
    }
    for (; x + 1 < ink.width; ++x)
      if (here[x] == value) see(x, y);
  }
}

/// Flips pixels of the given colour that are features; `value` 1: bumps of ink, 0: dents. Adds them
/// to a list.
void flip_features(Binary& ink, std::uint8_t value, std::vector<std::size_t>& flipped) {
  static const Rules kRules;
  const int rows = ink.height - 2;  // the first and the last have none
  std::vector<std::vector<std::size_t>> flips(
      rows > 0 ? static_cast<std::size_t>((rows + kRowsAtOnce - 1) / kRowsAtOnce) : 0);
  const unsigned invert = value ? 0U : 255U;
  const auto seen = [&](int x, int y) { return (neighbours_of(ink, x, y) ^ invert) & 255U; };
  const auto look = [&](int x, int y, std::vector<std::size_t>& found) {
    const unsigned n = seen(x, y);
    bool flip = kRules.bump[n];
    if (!flip && kRules.long_bump[n]) {
      for (const auto& [dx, dy] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        flip = flip || (ink.at(x + dx, y + dy) == value && kRules.long_bump[seen(x + dx, y + dy)]);
    }
    if (flip) found.push_back(ink.index(x, y));
  };
  for_rows(1, ink.height - 1, [&](int first, int last) {
    auto& found = flips[static_cast<std::size_t>((first - 1) / kRowsAtOnce)];
    visit_chosen(
        ink, first, last, value,
        [](const Around& p) { return ~(p.left & p.right & p.above & p.below); },
        [&](int x, int y) { look(x, y, found); });
  });
  for (const auto& band : flips) {
    for (const std::size_t i : band) ink.data[i] = static_cast<std::uint8_t>(1 - value);
    flipped.insert(flipped.end(), band.begin(), band.end());
  }
}

/// Of pixels that went, in order, those that hang together and have no ink beside them; pieces of
/// fewer than three have no size.
InkPieces lost_pieces(const Binary& ink, const std::vector<std::size_t>& gone) {
  constexpr std::size_t kFewest = 3;
  InkPieces lost;
  std::vector<bool> seen(gone.size());
  const auto take = [&](int x, int y) {
    const auto at = std::ranges::lower_bound(gone, ink.index(x, y));
    if (at == gone.end() || *at != ink.index(x, y)) return false;
    const auto k = static_cast<std::size_t>(at - gone.begin());
    const bool first = !seen[k];
    seen[k] = true;
    return first;
  };
  const auto stands_alone = [&](int x, int y) { return neighbours_of(ink, x, y) == 0; };
  const auto width = static_cast<std::size_t>(ink.width);
  for (std::size_t k = 0; k < gone.size(); ++k) {
    const std::size_t i = gone[k];
    if (seen[k] || !stands_alone(static_cast<int>(i % width), static_cast<int>(i / width)))
      continue;
    seen[k] = true;
    std::vector<std::size_t> piece = {i};
    bool alone = true;
    follow_piece(ink, true, piece, take, [&](int x, int y) {
      alone = alone && stands_alone(x, y);
      return true;
    });
    if (alone && piece.size() >= kFewest) lost.add(piece);
  }
  return lost;
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

/// The piece around `start` where it has fewer than `least` pixels, else as many of it; of paper, a
/// piece that touches the rim counts as large.
bool is_small(Binary& ink, std::size_t start, bool diagonal, std::size_t least,
              std::vector<std::size_t>& piece) {
  const std::uint8_t value = ink.data[start];
  piece.assign(1, start);
  ink.data[start] |= kSeen;
  bool large = false;
  const auto take = [&](int x, int y) {
    std::uint8_t& pixel = ink.data[ink.index(x, y)];
    if (pixel != value) return false;
    pixel |= kSeen;
    return true;
  };
  follow_piece(ink, diagonal, piece, take, [&](int x, int y) {
    large = piece.size() >= least ||
            (value == 0 && (x == 0 || y == 0 || x + 1 == ink.width || y + 1 == ink.height));
    return !large;
  });
  for (const std::size_t i : piece) ink.data[i] = value;
  return !large;
}

/// Flips connected pieces of `value` of fewer than `least` pixels. Pieces of paper that touch the
/// rim are no holes. A piece is looked for at pixels that can be its first, row by row; all those
/// flipped are added to `pieces`.
void flip_small(Binary& ink, std::uint8_t value, int least, bool diagonal, InkPieces& pieces) {
  if (least <= 1) return;
  std::vector<std::size_t> piece;
  const auto look = [&](int x, int y) {
    const auto is = [&](int u, int v) { return ink.contains(u, v) && ink.at(u, v) == value; };
    if (ink.at(x, y) != value || is(x - 1, y) || is(x, y - 1)) return;
    if (diagonal && (is(x - 1, y - 1) || is(x + 1, y - 1))) return;
    if (!is_small(ink, ink.index(x, y), diagonal, static_cast<std::size_t>(least), piece)) return;
    for (const std::size_t i : piece) ink.data[i] = static_cast<std::uint8_t>(1 - value);
    pieces.add(piece);
  };
  for (int x = 0; x < ink.width; ++x) look(x, 0);
  for (int y = 1; y < ink.height; ++y) look(0, y);
  visit_chosen(
      ink, 1, ink.height - 1, value, [](const Around& p) { return ~(p.left | p.above); }, look);
  for (int y = 1; y < ink.height; ++y) look(ink.width - 1, y);
  for (int x = 0; x < ink.width; ++x) look(x, ink.height - 1);
}

std::int64_t count_pixels(const InkPieces& pieces) {
  return static_cast<std::int64_t>(pieces.pixels.size());
}

void put_back(Binary& ink, std::span<const std::size_t> pixels) {
  for (const std::size_t i : pixels) ink.data[i] = 1;
}

/// Of pieces that went, dashes in rows are ink again. The others are kept apart.
void put_back_rows(Binary& ink, const InkPieces& gone, Removed& removed) {
  const std::vector<bool> in_row = dashes_in_rows(gone, ink.width);
  for (std::size_t i = 0; i < gone.size(); ++i)
    if (in_row[i]) {
      put_back(ink, gone[i]);
    } else {
      removed.specks.add(gone[i]);
    }
}

}  // namespace

void erode(Binary& ink) { grow(ink, 0); }
void dilate(Binary& ink) { grow(ink, 1); }

void smooth_pixels(Binary& ink, int times) {
  for (int i = 0; i < times; ++i) erode(ink);
  for (int i = 0; i < 2 * times; ++i) dilate(ink);
  for (int i = 0; i < times; ++i) erode(ink);
}

Smoothed smooth_edges(Binary& ink, int times) {
  std::vector<std::size_t> bumps;
  std::vector<std::size_t> dents;
  for (int i = 0; i < times; ++i) {
    flip_features(ink, 1, bumps);
    flip_features(ink, 0, dents);
  }
  const auto changed = static_cast<long>(bumps.size() + dents.size());
  std::ranges::sort(bumps);
  bumps.erase(std::ranges::unique(bumps).begin(), bumps.end());
  std::erase_if(bumps, [&](std::size_t i) { return ink.data[i] != 0; });
  return {changed, lost_pieces(ink, bumps)};
}

Removed remove_specks(Binary& ink, int specks, int pinholes) {
  InkPieces pieces;
  flip_small(ink, 0, pinholes, false, pieces);
  Removed removed;
  removed.pinholes = static_cast<int>(pieces.size());
  pieces = {};
  flip_small(ink, 1, specks, true, pieces);
  const std::int64_t gone = count_pixels(pieces);
  const std::int64_t all = gone + count_ink(ink.data.data(), ink.data.size());
  if (2 * gone > all) {
    put_back(ink, pieces.pixels);
    pieces = {};
    flip_small(ink, 1, specks / 2, true, pieces);
    if (2 * (gone - count_pixels(pieces)) <= all) flip_small(ink, 1, specks, true, pieces);
  }
  put_back_rows(ink, pieces, removed);
  return removed;
}

InkPieces take_pieces(Binary& ink) {
  InkPieces pieces;
  flip_small(ink, 1, std::numeric_limits<int>::max(), true, pieces);
  return pieces;
}

}  // namespace keyline::sketch
