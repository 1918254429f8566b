#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <string>
#include <vector>

#include <png.h>

#include "keyline/exchange/image/image_reader.h"

namespace keyline::exchange::detail {
namespace {

using core::Result;
using sketch::Image;

/// What libpng's callbacks share with us; outlives every jump out of them.
struct Source {
  std::string_view bytes;
  std::size_t at = 0;
  std::string message;
};

void read_bytes(png_structp png, png_bytep out, png_size_t count) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (source.bytes.size() - source.at < count) png_error(png, "it ends too early");
  std::memcpy(out, source.bytes.data() + source.at, count);
  source.at += count;
}

void on_error(png_structp png, png_const_charp text) {
  static_cast<Source*>(png_get_error_ptr(png))->message = text;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

struct Reader {
  png_structp png = nullptr;
  png_infop info = nullptr;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

bool is_transparent(png_structp png, png_infop info) {
  return (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0 ||
         png_get_valid(png, info, PNG_INFO_tRNS) != 0;
}

/// Asks libpng for 16 bit grey, with opacity if there is any, in the machine's byte order.
void set_transforms(png_structp png, png_infop info) {
  png_set_expand_16(png);
  // only a file of another gamma is converted: libpng then weighs colours in linear light
  double gamma = 0;
  if (png_get_gAMA(png, info, &gamma) && std::abs(gamma - 0.4545) > 0.05)
    png_set_gamma(png, PNG_DEFAULT_sRGB, gamma);
  if (png_get_color_type(png, info) & PNG_COLOR_MASK_COLOR)
    png_set_rgb_to_gray_fixed(png, PNG_ERROR_ACTION_NONE, 29900, 58700);
  if constexpr (std::endian::native == std::endian::little) png_set_swap(png);
}

/// The header, up to the pixels; false after a jump. No object with a destructor lives here.
bool read_header(png_structp png, png_infop info) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_info(png, info);
  return true;
}

/// `channels` numbers a pixel into `rows`; `take` is called after each row that is complete.
template <class Take>
bool read_rows(png_structp png, png_infop info, png_bytep* rows, int channels, const Take& take) {
  if (setjmp(png_jmpbuf(png))) return false;
  set_transforms(png, info);
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const png_uint_32 height = png_get_image_height(png, info);
  const auto numbers = static_cast<std::size_t>(channels) * png_get_image_width(png, info);
  if (png_get_rowbytes(png, info) != 2 * numbers) png_error(png, "its pixels have an unknown form");
  for (int pass = 1; pass <= passes; ++pass)
    for (png_uint_32 y = 0; y < height; ++y) {
      png_read_row(png, rows[y], nullptr);
      if (pass == passes) take(static_cast<int>(y));
    }
  png_read_end(png, info);
  return true;
}

bool read_grey(png_structp png, png_infop info, Image& image) {
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.height(); ++y)
    rows.push_back(reinterpret_cast<png_bytep>(&image.luminance.at(0, y)));
  return read_rows(png, info, rows.data(), 1, [](int) {});
}

/// Rows of grey and opacity, kept no longer than until they are laid; of interlaced pictures all
/// are complete with the last pass only.
bool read_transparent(png_structp png, png_infop info, Image& image) {
  const bool interlaced = png_get_interlace_type(png, info) != PNG_INTERLACE_NONE;
  sketch::Raster<std::uint16_t> pixels(2 * image.width(), interlaced ? image.height() : 1);
  const auto row = [&](int y) { return &pixels.at(0, interlaced ? y : 0); };
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.height(); ++y) rows.push_back(reinterpret_cast<png_bytep>(row(y)));
  return read_rows(png, info, rows.data(), 2, [&](int y) {
    const std::uint16_t* p = row(y);
    for (int x = 0; x < image.width(); ++x, p += 2) {
      const double opacity = p[1] / 65535.0;
      lay(image, image.luminance.index(x, y), p[0] * opacity, opacity);
    }
  });
}

/// Chunks that say nothing about the pixels are passed over; libpng would make room for what their
/// headers state, whatever its limits.
void skip_texts(png_structp png) {
  static constexpr png_byte kNames[] = "tEXt\0zTXt\0iTXt\0iCCP\0sPLT\0hIST\0pCAL\0sCAL";
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, kNames, sizeof kNames / 5);
}

}  // namespace

Result<Image> read_png(std::string_view bytes) {
  Source source{bytes, 0, {}};
  Reader reader;
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
  reader.info = png_create_info_struct(reader.png);
  png_set_read_fn(reader.png, &source, read_bytes);
  png_set_user_limits(reader.png, 0x7fffffff, 0x7fffffff);
  png_set_chunk_malloc_max(reader.png, 8u << 20);
  skip_texts(reader.png);
  if (!read_header(reader.png, reader.info)) return damaged(source.message);
  const std::int64_t width = png_get_image_width(reader.png, reader.info);
  const std::int64_t height = png_get_image_height(reader.png, reader.info);
  const double raw =
      static_cast<double>(height) * static_cast<double>(png_get_rowbytes(reader.png, reader.info));
  constexpr double kBestDeflate = 1040;  // deflate cannot pack closer
  auto image = new_image(width, height, raw / kBestDeflate, bytes.size());
  if (!image) return image;
  const auto read = is_transparent(reader.png, reader.info) ? read_transparent : read_grey;
  if (!read(reader.png, reader.info, *image)) return damaged(source.message);
  image->pixels_per_mm = png_get_pixels_per_meter(reader.png, reader.info) / 1000.0;
  png_bytep exif = nullptr;
  png_uint_32 size = 0;
  if (png_get_eXIf_1(reader.png, reader.info, &size, &exif))
    apply_orientation(*image, exif_orientation({reinterpret_cast<const char*>(exif), size}));
  return image;
}

}  // namespace keyline::exchange::detail
