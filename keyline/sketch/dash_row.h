#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::sketch {

/// What makes a row of dashes.
inline constexpr double kRowTurn = 0.4;  ///< radians, from a dash to the next
inline constexpr double kRowGap = 3;     ///< times the shorter dash: no gap of a row is longer
inline constexpr double kEven = 1.5;     ///< times another: gaps of one row
inline constexpr double kGrid = 1;       ///< pixels that a length, or an end beside it, may be off

/// True where gaps that long may be those of one row.
bool is_even(double gap, double other);

/// Pieces of ink, each a list of pixels: indices into the picture's rows.
struct InkPieces {
  std::vector<std::size_t> pixels;  ///< of one piece after the other
  std::vector<std::size_t> ends;    ///< where each ends in that list

  std::size_t size() const { return ends.size(); }
  std::span<const std::size_t> operator[](std::size_t piece) const {
    const std::size_t first = piece == 0 ? 0 : ends[piece - 1];
    return std::span(pixels).subspan(first, ends[piece] - first);
  }
  void add(std::span<const std::size_t> piece) {
    pixels.insert(pixels.end(), piece.begin(), piece.end());
    ends.push_back(pixels.size());
  }
  void add(const InkPieces& others) {
    for (std::size_t k = 0; k < others.size(); ++k) add(others[k]);
  }
};

/// A piece of ink as a straight line.
struct Dash {
  std::size_t piece = 0;
  double length = 0;
  core::Point2 middle{};
  std::array<core::Point2, 2> end{};
  core::Vector2 along{};  ///< from the first end to the second
};

/// The piece's mean, its principal axis, and how far it goes along that; of a picture with rows of
/// `width` pixels.
Dash dash_of(std::span<const std::size_t> piece, std::size_t number, std::size_t width);

/// Which pieces of a picture with rows of `width` pixels are dashes: at least four times as long as
/// broad (drawings have six, [ISO 128-20], half as much again as gaps of a row may differ), and one
/// of three that follow each other in a row, with even gaps. None is where no more than half of
/// what is that long lies in rows: of much dirt some does by chance.
std::vector<bool> dashes_in_rows(const InkPieces& pieces, int width);

}  // namespace keyline::sketch
