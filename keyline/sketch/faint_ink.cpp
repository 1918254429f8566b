#include "keyline/sketch/faint_ink.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "keyline/core/quantile.h"
#include "keyline/sketch/rows.h"

namespace keyline::sketch {
namespace {

constexpr double kStandsOut = 2;  ///< times as dark as what lies beside it: half its height

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

using Piece = std::vector<std::pair<int, int>>;

/// Pixels of the piece that holds one; they are taken out.
Piece take_piece(FaintPixels& faint, int x, int y) {
  Piece piece{{x, y}};
  faint.clear(x, y);
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const auto [at_x, at_y] = piece[k];
    for (int v = at_y - 1; v <= at_y + 1; ++v)
      for (int u = at_x - 1; u <= at_x + 1; ++u)
        if (faint.contains(u, v) && faint.at(u, v)) {
          faint.clear(u, v);
          piece.emplace_back(u, v);
        }
  }
  return piece;
}

/// Takes out what is farther than `reach` from all ink, and calls see(piece) for every piece of it
/// that is as large as `specks`.
template <class See>
void take_lost(FaintPixels& faint, const Binary& ink, double reach, int specks, const See& see) {
  clear_near_ink(faint, ink, reach);
  for (int y = 0; y < faint.height(); ++y)
    faint.visit(y, [&](int x) {
      const Piece piece = take_piece(faint, x, y);
      if (piece.size() >= static_cast<std::size_t>(std::max(specks, 1))) see(piece);
    });
}

void set(Binary& ink, const Piece& piece, std::uint8_t value) {
  for (const auto& [x, y] : piece) ink.at(x, y) = value;
}

constexpr std::uint8_t kInk = 1;
constexpr std::uint8_t kPiece = 2;  ///< of ink, the piece that is looked at

/// What a piece is like; other ink is 0 or kInk meanwhile.
struct PieceLook {
  std::size_t inside = 0;  ///< of its places so many pixels away to four sides, those in itself
  double own = 0;          ///< darkness, median
  std::optional<double> beside;  ///< of the darker of two on opposite sides, outside of all ink
};

PieceLook look_at(Binary& ink, const Tone& tone, const Piece& piece, int away) {
  PieceLook look;
  std::vector<double> own;
  std::vector<double> beside;
  const auto darkness = [&tone](int x, int y) {
    return darkness_of(tone.level.at(x, y) / static_cast<double>(Tone::kWhite), tone.gain);
  };
  set(ink, piece, kPiece);
  for (const auto& [x, y] : piece) {
    own.push_back(darkness(x, y));
    for (const auto& [across, down] : {std::pair{away, 0}, {0, away}}) {
      double darker = -1;
      for (const auto& [u, v] : {std::pair{x - across, y - down}, {x + across, y + down}}) {
        if (!ink.contains(u, v)) continue;
        look.inside += ink.at(u, v) == kPiece;
        if (!ink.at(u, v)) darker = std::max(darker, darkness(u, v));
      }
      if (darker >= 0) beside.push_back(darker);
    }
  }
  set(ink, piece, 0);  // it is no ink that others lie near
  look.own = core::quantile(own);
  if (!beside.empty()) look.beside = core::quantile(beside);
  return look;
}

/// Twice as dark as what else lies there, on both sides: shade that hardly passes for ink has shade
/// beside it that hardly does not, at its edge on one side.
bool stands_out(const PieceLook& look) { return look.own >= kStandsOut * *look.beside; }

/// A broad piece has itself on most sides, so many pixels away, a line on two of four at most.
bool is_line(const PieceLook& look, const Piece& piece) {
  return look.inside <= 2 * piece.size() && look.beside && stands_out(look);
}

}  // namespace

std::size_t count_lost(FaintPixels& faint, Binary& ink, const Tone& tone, const FaintLine& wanted) {
  const int away = static_cast<int>(std::ceil(wanted.broadest));
  std::size_t lost = 0;
  take_lost(faint, ink, wanted.reach, wanted.specks, [&](const Piece& piece) {
    const PieceLook look = look_at(ink, tone, piece, away);
    if (!look.beside || stands_out(look)) lost += piece.size();
  });
  return lost;
}

std::size_t ink_lines(FaintPixels& faint, Binary& ink, const Tone& tone, const FaintLine& wanted) {
  const int away = static_cast<int>(std::ceil(wanted.broadest));
  std::vector<Piece> lines;
  std::vector<Piece> others;
  take_lost(faint, ink, wanted.reach, wanted.specks, [&](Piece piece) {
    const bool line = is_line(look_at(ink, tone, piece, away), piece);
    (line ? lines : others).push_back(std::move(piece));
  });
  std::size_t count = 0;
  for (const Piece& piece : lines) {
    set(ink, piece, kInk);
    count += piece.size();
  }
  for (const Piece& piece : others)
    for (const auto& [x, y] : piece) faint.set(x, y);
  return count;
}

std::size_t drop_shade(Binary& ink, const Tone& tone, double broadest) {
  FaintPixels left(ink.width, ink.height);
  for (int y = 0; y < ink.height; ++y)
    for (int x = 0; x < ink.width; ++x)
      if (ink.at(x, y)) left.set(x, y);
  const int away = static_cast<int>(std::ceil(broadest));
  std::size_t dropped = 0;
  for (int y = 0; y < ink.height; ++y)
    left.visit(y, [&](int x) {
      const Piece piece = take_piece(left, x, y);
      const PieceLook look = look_at(ink, tone, piece, away);
      if (look.beside && !stands_out(look))
        dropped += piece.size();
      else
        set(ink, piece, kInk);
    });
  return dropped;
}

}  // namespace keyline::sketch
