#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <string>
#include <string_view>

#include "keyline/core/error.h"
#include "keyline/sketch/image.h"

/// Pictures as room sketch takes them. Formats are told apart by their first bytes, never by name.
namespace keyline::exchange {

/// True for .png, .jpg, .jpeg, .tif, .tiff, .webp in either case.
bool has_image_name(const std::filesystem::path& path);

/// Decodes a PNG, JPEG, TIFF or WebP picture of 1 to 16 bits a channel, grey or colour (weighted
/// 0.299, 0.587, 0.114), transparency laid over white, turned upright by its EXIF orientation.
/// Where most of it is transparent and some of it lighter than mid grey it is laid over black, for
/// light lines are lost on white (on_black); over both if some of it is darker, too (over_black).
///
/// Memory: 2 bytes per pixel for the answer (4 over both) and at most 4 more while decoding.
/// Fails:  bad_input for other or damaged files, and where the header states more than 64
///         megapixels (sketch::kMaxPixels) or more than the file can hold: before anything of that
///         size is allocated.
core::Result<sketch::Image> read_image(std::string_view bytes);

/// The same from a file of at most 512 MB; io where it cannot be read.
core::Result<sketch::Image> read_image_file(const std::filesystem::path& path);

namespace detail {

/// These lay what is transparent over white, and over black too if there is any.
core::Result<sketch::Image> read_png(std::string_view bytes);
core::Result<sketch::Image> read_jpeg(std::string_view bytes);
core::Result<sketch::Image> read_tiff(std::string_view bytes);
core::Result<sketch::Image> read_webp(std::string_view bytes);

/// An image of that size, or why not. `least_bytes` is what the file has to hold at least for it.
core::Result<sketch::Image> new_image(std::int64_t width, std::int64_t height, double least_bytes,
                                      std::size_t bytes);

/// The failure of a picture that is damaged; `what` ends the sentence "the picture is damaged: ".
std::unexpected<core::Failure> damaged(const std::string& what);

/// 0 … 65535 of channels in the same range.
std::uint16_t luminance(double red, double green, double blue);
/// Sets pixel i, of level v on black and opacity 0 … 1, on the grounds needed so far; the first
/// that is not opaque makes room for the second ground.
void lay(sketch::Image& image, std::size_t i, double v, double opacity);

/// Orientation (1 … 8) stated by an EXIF block (TIFF structure, with or without "Exif\0\0" before
/// it); 1 where there is none.
int exif_orientation(std::string_view exif);
/// Turns the image upright, on both grounds.
void apply_orientation(sketch::Image& image, int orientation);

}  // namespace detail
}  // namespace keyline::exchange
