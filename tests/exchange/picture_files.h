#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Files of one small test picture in every format, written by the formats' own libraries.
namespace keyline::exchange::tests {

constexpr int kWidth = 24;
constexpr int kHeight = 16;

/// Red grows to the right, green downwards: every place has its own luminance.
std::vector<unsigned char> rgb_pixels();

/// Luminance of the test picture at pixel (x, y), in [0, 65535].
double expected(int x, int y);

/// PNG of any pixels, 4 pixels per mm; orientation 0 writes no EXIF chunk.
std::string png_of(int color_type, int depth, const std::vector<unsigned char>& bytes, int width,
                   int height, bool interlaced = false, int orientation = 0);

/// JPEG of best quality, 254 dots per inch; orientation 0 writes no EXIF marker.
std::string jpeg_of(const std::vector<unsigned char>& rgb, int orientation = 0);

/// Pixels of the test picture as inks, with or without the marker that says they are inverted.
std::string cmyk_jpeg(bool adobe);

/// TIFF of 8 or 16 bits, grey (1 sample) or colour (3), 300 dots per inch, in strips or tiles.
std::string tiff_of(int bits, int samples, int orientation, bool tiled = false);

/// Lossless, without and with the chunks of the extended form that hold EXIF.
std::string webp_of();
std::string webp_with_exif(int orientation);

std::string file_content(const std::filesystem::path& file);

}  // namespace keyline::exchange::tests
