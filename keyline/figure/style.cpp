#include "keyline/figure/style.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace keyline::figure {

namespace {

/// (1 - u) a + u b, channel by channel.
Color mixed(Color a, Color b, double u) {
  const auto mix = [u](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + u * (to - from)));
  };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue), 1};
}

}  // namespace

Color lighter(Color c, double amount) { return mixed(c, kPaper, std::clamp(amount, 0.0, 1.0)); }

Color palette(std::size_t index) {
  static constexpr std::array<Color, 8> kColors = {{{0, 105, 170},
                                                    {206, 84, 0},
                                                    {0, 133, 98},
                                                    {178, 70, 130},
                                                    {150, 110, 0},
                                                    {40, 135, 190},
                                                    {105, 60, 160},
                                                    {95, 95, 95}}};
  return kColors[index % kColors.size()];
}

Color sequential(double u) {
  static constexpr std::array<Color, 6> kStops = {{{48, 32, 96},
                                                   {48, 72, 140},
                                                   {34, 116, 142},
                                                   {52, 158, 122},
                                                   {140, 196, 78},
                                                   {246, 226, 72}}};
  const double x = std::isfinite(u) ? std::clamp(u, 0.0, 1.0) * (kStops.size() - 1) : 0;
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(x), kStops.size() - 2);
  return mixed(kStops[i], kStops[i + 1], x - static_cast<double>(i));
}

}  // namespace keyline::figure
