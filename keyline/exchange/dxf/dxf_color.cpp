#include "keyline/exchange/dxf/dxf_color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "keyline/document/color.h"

namespace keyline::exchange::detail {
namespace {

int channel(double value) { return static_cast<int>(255 * value + 1e-9); }  // from 0 to 1

/// Share of one primary at a hue in degrees: 1 within 60 of it, falling to 0 at 120.
double primary(double hue, double own) {
  const double away = std::abs(std::remainder(hue - own, 360));
  return std::clamp(2 - away / 60, 0.0, 1.0);
}

}  // namespace

std::string true_color(int value) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (int shift = 20; shift >= 0; shift -= 4) text += kDigits[(value >> shift) & 15];
  return text;
}

std::string aci_color(int index) {
  static constexpr std::array<int, 10> kBasic = {0,        0xff0000, 0xffff00, 0x00ff00, 0x00ffff,
                                                 0x0000ff, 0xff00ff, 0x000000, 0x808080, 0xc0c0c0};
  static constexpr std::array<int, 6> kGreys = {0x33, 0x5b, 0x84, 0xad, 0xd6, 0xff};
  static constexpr std::array<double, 5> kShades = {1, 0.65, 0.5, 0.3, 0.15};
  if (index < 1 || index > 255) return {};
  if (index < 10) return true_color(kBasic[static_cast<std::size_t>(index)]);
  if (index >= 250) return true_color(0x010101 * kGreys[static_cast<std::size_t>(index - 250)]);
  const int step = (index - 10) / 10;
  const double hue = 15.0 * step;
  const double value = kShades[static_cast<std::size_t>(index % 10 / 2)];
  const double least = index % 2 == 1 ? 0.5 : 0;
  int rgb = 0;
  for (const double own : {0.0, 120.0, 240.0})
    rgb = rgb << 8 | channel(value * (least + (1 - least) * primary(hue, own)));
  return true_color(rgb);
}

int nearest_aci(int rgb) {
  int best = 7;
  int least = std::numeric_limits<int>::max();
  for (int index = 1; index <= 255; ++index) {
    const int other = document::color_value(aci_color(index));
    int square = 0;
    for (const int shift : {0, 8, 16}) {
      const int off = (rgb >> shift & 255) - (other >> shift & 255);
      square += off * off;
    }
    if (square < least) {
      least = square;
      best = index;
    }
  }
  return best;
}

}  // namespace keyline::exchange::detail
