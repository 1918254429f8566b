#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace keyline::sketch {

/// Rows of pixels, top row first; pixel (x, y) is the square [x, x + 1] × [y, y + 1].
template <class T>
struct Raster {
  int width = 0;
  int height = 0;
  std::vector<T> data;

  Raster() = default;
  Raster(int columns, int rows, T value = {})
      : width(columns),
        height(rows),
        data(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), value) {}

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  T& at(int x, int y) { return data[index(x, y)]; }
  const T& at(int x, int y) const { return data[index(x, y)]; }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
};

/// Where the one of `parts` about equal parts of a picture's side begins.
inline int part_start(int length, int parts, int one) {
  return static_cast<int>(static_cast<long>(length) * one / parts);
}

/// Most pixels an image may have: 64 megapixels.
inline constexpr std::int64_t kMaxPixels = 64LL << 20;

/// A picture as the sketch room takes it: luminance (0 black, 65535 white, encoded as in sRGB),
/// colours weighted, transparency laid over white (or black), turned upright.
struct Image {
  Raster<std::uint16_t> luminance;
  double pixels_per_mm = 0;  ///< resolution the file states; 0: none
  bool on_black = false;     ///< laid over black: light lines on a transparent ground
  /// The same laid over black, where what is drawn on a transparent ground is dark and light
  /// (light_lines.h); else empty.
  Raster<std::uint16_t> over_black;
  std::size_t further_pages = 0;  ///< pictures of the file beside this one

  int width() const { return luminance.width; }
  int height() const { return luminance.height; }
};

/// True where the size is one the room works with.
constexpr bool is_allowed_size(std::int64_t width, std::int64_t height) {
  return width > 0 && height > 0 && width <= kMaxPixels && height <= kMaxPixels / width;
}

}  // namespace keyline::sketch
