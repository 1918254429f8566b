#pragma once

#include <algorithm>
#include <cstdint>

#include "keyline/core/point.h"
#include "keyline/sketch/image.h"

/// Pages to draw straight lines on.
namespace keyline::sketch::testing {

inline Image blank_page(int width, int height, std::uint16_t paper = 65535) {
  Image page;
  page.luminance = Raster<std::uint16_t>(width, height, paper);
  return page;
}

/// Takes the share `ink` of the light where the line covers a pixel; y down.
inline void draw_line(Image& image, core::Point2 from, core::Point2 to, double width,
                      double ink = 0.9) {
  const core::Vector2 d = to - from;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const core::Point2 p{x + 0.5, y + 0.5};
      const double u = std::clamp(core::dot(p - from, d) / core::dot(d, d), 0.0, 1.0);
      const double off = core::distance(p, from + u * d);
      const double cover = std::clamp(0.5 + 0.5 * width - off, 0.0, 1.0);
      std::uint16_t& v = image.luminance.at(x, y);
      v = static_cast<std::uint16_t>(v * (1 - ink * cover));
    }
}

}  // namespace keyline::sketch::testing
