#pragma once

#include <cstdint>
#include <optional>

#include "keyline/core/describe.h"
#include "keyline/sketch/image.h"
#include "keyline/sketch/margins.h"

namespace keyline::sketch {

enum class Polarity { automatic, dark_on_light, light_on_dark };
constexpr auto choices(const Polarity*) {
  return core::words<Polarity>({{Polarity::automatic, "auto"},
                                {Polarity::dark_on_light, "dark"},
                                {Polarity::light_on_dark, "light"}});
}
enum class Flatten { automatic, on, off };
constexpr auto choices(const Flatten*) {
  return core::words<Flatten>(
      {{Flatten::automatic, "auto"}, {Flatten::on, "on"}, {Flatten::off, "off"}});
}

struct ToneOptions {
  /// The a of y = a·log x (x from 1 to 256, y = 1 is white); empty: such that the paper is white.
  std::optional<double> gain;
  Polarity polarity = Polarity::automatic;
  Flatten flatten = Flatten::automatic;  ///< automatic: where the paper's brightness varies
};

/// The picture after the light intensity transformation.
struct Tone {
  /// kWhite times y: paper is kWhite and near it, ink is lower. Lines light on dark are turned
  /// into dark on light first.
  Raster<std::uint16_t> level;
  double gain = 0;
  bool light_on_dark = false;
  bool flattened = false;
  Margins margins;    ///< that were made as light as the paper
  double noise = 0;   ///< standard deviation of y on paper
  double shaded = 0;  ///< share of the picture a third darker than paper, before flattening

  static constexpr double kWhite = 60000;  ///< some headroom above for what outshines the paper
};

/// Share of the paper's light that is missing at level y: 0 on paper, 1 in black. Unlike y it grows
/// evenly with the part of a pixel that ink covers.
double darkness_of(double y, double gain);

/// Light intensity transformation y = a·log x ([Sketch] Eq. 11), after single stray pixels (salt
/// and pepper) and dark margins were taken out; on request or need the paper's own brightness,
/// estimated from blocks, is divided out.
Tone transform_intensity(Image image, const ToneOptions& options = {});

/// Blurs the levels (sigma in pixels), which closes the grain of a pencil, and measures the noise
/// that is left.
void blur_levels(Tone& tone, double sigma);

/// Whether ink is lighter than paper: ink is the longer tail of the blocks' brightness.
bool is_light_on_dark(const Image& image);

}  // namespace keyline::sketch
