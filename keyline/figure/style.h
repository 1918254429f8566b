#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace keyline::figure {

/// sRGB colour; alpha 0 (clear) to 1 (solid).
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  double alpha = 1;
  friend bool operator==(const Color&, const Color&) = default;
};

constexpr Color with_alpha(Color c, double alpha) { return {c.red, c.green, c.blue, alpha}; }

/// Part `amount` (0 … 1) of the way from c to white, solid.
Color lighter(Color c, double amount);

inline constexpr Color kPaper{255, 255, 255};
inline constexpr Color kInk{33, 37, 41};       ///< titles and main lines
inline constexpr Color kSoftInk{90, 98, 104};  ///< tick labels, captions
inline constexpr Color kFrame{173, 181, 189};  ///< axes
inline constexpr Color kGrid{233, 236, 239};   ///< grid lines
inline constexpr Color kRaw{140, 147, 153};    ///< measured data
inline constexpr Color kWarning{202, 71, 8};   ///< beyond tolerance

/// Categorical colours told apart with any common colour vision deficiency and on grey prints of
/// neighbours; the sequence repeats after eight. Darkened from the set of Okabe and Ito so that
/// thin lines keep a contrast of at least 3:1 on white.
Color palette(std::size_t index);

/// Sequential scale from deep blue (u = 0) through green to yellow (u = 1); lightness rises evenly.
Color sequential(double u);

/// Line on the page; width and dash lengths in the drawing's unit. Empty dash: solid.
struct Stroke {
  Color color = kInk;
  double width = 1;
  std::vector<double> dash = {};
  friend bool operator==(const Stroke&, const Stroke&) = default;
};

}  // namespace keyline::figure
