#include "keyline/sketch/faint_ink.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "keyline/sketch/rows.h"

namespace keyline::sketch {
namespace {

/// Whether ink lies within so many pixels, row by row: `half` has the half width of a disc's.
bool near_ink(const Binary& ink, int x, int y, const std::vector<int>& half) {
  const int rows = static_cast<int>(half.size()) - 1;
  for (int v = std::max(0, y - rows); v <= std::min(ink.height - 1, y + rows); ++v) {
    const int across = half[static_cast<std::size_t>(std::abs(v - y))];
    const int left = std::max(0, x - across);
    const int right = std::min(ink.width - 1, x + across);
    if (std::memchr(&ink.at(left, v), 1, static_cast<std::size_t>(right - left + 1))) return true;
  }
  return false;
}

void clear_near_ink(FaintPixels& faint, const Binary& ink, double reach) {
  std::vector<int> half;
  for (int v = 0; v <= reach; ++v)
    half.push_back(static_cast<int>(std::sqrt(reach * reach - v * v)));
  for_rows(0, ink.height, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      faint.visit(y, [&](int x) {
        if (near_ink(ink, x, y, half)) faint.clear(x, y);
      });
  });
}

/// Pixels of the piece that holds one; they are taken out.
std::size_t take_piece(FaintPixels& faint, int x, int y) {
  std::vector<std::pair<int, int>> open{{x, y}};
  faint.clear(x, y);
  std::size_t count = 0;
  while (!open.empty()) {
    const auto [at_x, at_y] = open.back();
    open.pop_back();
    ++count;
    for (int v = at_y - 1; v <= at_y + 1; ++v)
      for (int u = at_x - 1; u <= at_x + 1; ++u)
        if (faint.contains(u, v) && faint.at(u, v)) {
          faint.clear(u, v);
          open.emplace_back(u, v);
        }
  }
  return count;
}

}  // namespace

std::size_t count_lost(FaintPixels& faint, const Binary& ink, double reach, int specks) {
  clear_near_ink(faint, ink, reach);
  std::size_t lost = 0;
  for (int y = 0; y < faint.height(); ++y)
    faint.visit(y, [&](int x) {
      const std::size_t piece = take_piece(faint, x, y);
      if (piece >= static_cast<std::size_t>(std::max(specks, 1))) lost += piece;
    });
  return lost;
}

}  // namespace keyline::sketch
