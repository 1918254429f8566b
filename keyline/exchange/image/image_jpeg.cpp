#include <csetjmp>
#include <cstdio>
#include <vector>

#include <jpeglib.h>

#include "keyline/exchange/image/image_reader.h"

namespace keyline::exchange::detail {
namespace {

using core::Result;
using sketch::Image;

/// libjpeg's state with our own behind it; outlives every jump.
struct Reader {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  std::jmp_buf jump{};
  char message[JMSG_LENGTH_MAX] = "";
  bool truncated = false;
  Reader() = default;
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { jpeg_destroy_decompress(&info); }
};

void on_error(j_common_ptr common) {
  auto& reader = *static_cast<Reader*>(common->client_data);
  common->err->format_message(common, reader.message);
  std::longjmp(reader.jump, 1);
}

/// Warnings stand for damage libjpeg worked around: missing or corrupt data.
void on_message(j_common_ptr common, int level) {
  if (level < 0) {
    auto& reader = *static_cast<Reader*>(common->client_data);
    common->err->format_message(common, reader.message);
    reader.truncated = true;
  }
}

void on_output(j_common_ptr) {}

bool read_header(Reader& r, std::string_view bytes) {
  if (setjmp(r.jump)) return false;
  jpeg_create_decompress(&r.info);
  jpeg_mem_src(&r.info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_save_markers(&r.info, JPEG_APP0 + 1, 0xFFFF);
  jpeg_read_header(&r.info, TRUE);
  const bool inks = r.info.num_components == 4;
  r.info.out_color_space = inks                                       ? JCS_CMYK
                           : r.info.jpeg_color_space == JCS_GRAYSCALE ? JCS_GRAYSCALE
                                                                      : JCS_RGB;
  if (r.info.jpeg_color_space == JCS_YCbCr) r.info.out_color_space = JCS_GRAYSCALE;
  return true;
}

/// One decoded row to luminance. CMYK files with Adobe's marker hold inverted inks.
void convert_row(const unsigned char* in, int components, bool inverted, int width,
                 std::uint16_t* out) {
  const auto light = [inverted](unsigned char ink) { return inverted ? ink : 255 - ink; };
  for (int x = 0; x < width; ++x) {
    const unsigned char* p = in + static_cast<std::ptrdiff_t>(x) * components;
    if (components == 1) {
      out[x] = static_cast<std::uint16_t>(p[0] * 257);
    } else if (components == 3) {
      out[x] = luminance(p[0] * 257.0, p[1] * 257.0, p[2] * 257.0);
    } else {
      const double k = light(p[3]) / 255.0 * 257;
      out[x] = luminance(light(p[0]) * k, light(p[1]) * k, light(p[2]) * k);
    }
  }
}

bool read_pixels(Reader& r, Image& image, unsigned char* row) {
  if (setjmp(r.jump)) return false;
  jpeg_start_decompress(&r.info);
  while (r.info.output_scanline < r.info.output_height && !r.truncated) {
    const auto y = static_cast<int>(r.info.output_scanline);
    jpeg_read_scanlines(&r.info, &row, 1);
    convert_row(row, r.info.output_components, r.info.saw_Adobe_marker, image.width(),
                &image.luminance.at(0, y));
  }
  return !r.truncated;
}

double density(const jpeg_decompress_struct& info) {
  if (info.density_unit == 1) return info.X_density / 25.4;
  if (info.density_unit == 2) return info.X_density / 10.0;
  return 0;
}

}  // namespace

Result<Image> read_jpeg(std::string_view bytes) {
  Reader reader;
  reader.info.err = jpeg_std_error(&reader.errors);
  reader.info.client_data = &reader;
  reader.errors.error_exit = on_error;
  reader.errors.emit_message = on_message;
  reader.errors.output_message = on_output;
  if (!read_header(reader, bytes)) return damaged(reader.message);
  // a block of 64 pixels takes a bit at the least
  const double blocks = static_cast<double>(reader.info.image_width) / 16 *
                        static_cast<double>(reader.info.image_height) / 16;
  auto image =
      new_image(reader.info.image_width, reader.info.image_height, blocks / 64, bytes.size());
  if (!image) return image;
  std::vector<unsigned char> row(4 * static_cast<std::size_t>(image->width()));
  if (!read_pixels(reader, *image, row.data())) return damaged(reader.message);
  image->pixels_per_mm = density(reader.info);
  for (const jpeg_marker_struct* m = reader.info.marker_list; m; m = m->next)
    if (m->marker == JPEG_APP0 + 1)
      apply_orientation(*image,
                        exif_orientation({reinterpret_cast<const char*>(m->data), m->data_length}));
  return image;
}

}  // namespace keyline::exchange::detail
