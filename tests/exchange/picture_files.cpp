#include "picture_files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>

#include <jpeglib.h>
#include <png.h>
#include <tiffio.h>
#include <unistd.h>
#include <webp/encode.h>

namespace keyline::exchange::tests {
namespace fs = std::filesystem;
namespace {

/// An EXIF block that states nothing but the orientation.
std::string exif(int orientation) {
  std::string e("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0", 19);
  e += static_cast<char>(orientation);
  e += std::string(6, '\0');
  return e;
}

std::string webp_chunk(const char* name, std::string data) {
  std::string out(name);
  for (int k = 0; k < 4; ++k) out += static_cast<char>(data.size() >> 8 * k & 255);
  if (data.size() % 2 == 1) data += '\0';
  return out + data;
}

}  // namespace

std::vector<unsigned char> rgb_pixels() {
  std::vector<unsigned char> pixels;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (const int v : {10 * x, 15 * y, 100}) pixels.push_back(static_cast<unsigned char>(v));
  return pixels;
}

double expected(int x, int y) { return 257 * (0.299 * 10 * x + 0.587 * 15 * y + 0.114 * 100); }

std::string png_of(int color_type, int depth, const std::vector<unsigned char>& bytes, int width,
                   int height, bool interlaced, int orientation) {
  std::string out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &out,
      [](png_structp p, png_bytep data, png_size_t n) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<char*>(data), n);
      },
      nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), depth,
               color_type, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  std::string block = exif(orientation);
  if (orientation > 0)
    png_set_eXIf_1(png, info, static_cast<png_uint_32>(block.size()),
                   reinterpret_cast<png_bytep>(block.data()));
  png_set_pHYs(png, info, 4000, 4000, PNG_RESOLUTION_METER);
  const std::size_t row = bytes.size() / static_cast<std::size_t>(height);
  std::vector<png_bytep> rows;
  for (int y = 0; y < height; ++y)
    rows.push_back(const_cast<png_bytep>(bytes.data()) + static_cast<std::size_t>(y) * row);
  png_set_rows(png, info, rows.data());
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  png_destroy_write_struct(&png, &info);
  return out;
}

/// A JPEG of `samples` bytes a pixel; `adjust` sets what else it is to have, `begun` writes what
/// stands before the rows.
std::string written_jpeg(int samples, J_COLOR_SPACE space, const std::vector<unsigned char>& pixels,
                         const std::function<void(jpeg_compress_struct&)>& adjust,
                         const std::function<void(jpeg_compress_struct&)>& begun) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &data, &size);
  info.image_width = kWidth;
  info.image_height = kHeight;
  info.input_components = samples;
  info.in_color_space = space;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 100, TRUE);
  adjust(info);
  jpeg_start_compress(&info, TRUE);
  begun(info);
  const std::size_t stride = static_cast<std::size_t>(samples) * kWidth;
  while (info.next_scanline < info.image_height) {
    JSAMPROW row = const_cast<unsigned char*>(pixels.data()) + stride * info.next_scanline;
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  std::string out(reinterpret_cast<char*>(data), size);
  jpeg_destroy_compress(&info);
  std::free(data);
  return out;
}

std::string jpeg_of(const std::vector<unsigned char>& rgb, int orientation) {
  const auto density = [](jpeg_compress_struct& info) {
    info.density_unit = 1;
    info.X_density = info.Y_density = 254;
  };
  const auto turned = [&](jpeg_compress_struct& info) {
    if (orientation <= 0) return;
    const std::string marker = std::string("Exif\0\0", 6) + exif(orientation);
    jpeg_write_marker(&info, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(marker.data()),
                      static_cast<unsigned>(marker.size()));
  };
  return written_jpeg(3, JCS_RGB, rgb, density, turned);
}

std::string file_content(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::string tiff_of(int bits, int samples, int orientation, bool tiled) {
  const fs::path file =
      fs::temp_directory_path() / ("keyline-image-test-" + std::to_string(::getpid()) + ".tif");
  TIFF* tiff = TIFFOpen(file.c_str(), "w");
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, kWidth);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, kHeight);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, samples == 1 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, orientation);
  TIFFSetField(tiff, TIFFTAG_XRESOLUTION, 300.0);
  TIFFSetField(tiff, TIFFTAG_YRESOLUTION, 300.0);
  std::vector<unsigned char> pixels;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int s = 0; s < samples; ++s) {
        const double v = samples == 1 ? expected(x, y) / 257
                         : s == 0     ? 10 * x
                         : s == 1     ? 15 * y
                                      : 100;
        if (bits == 16) {
          const auto wide = static_cast<std::uint16_t>(std::lround(257 * v));
          pixels.push_back(static_cast<unsigned char>(wide & 0xff));
          pixels.push_back(static_cast<unsigned char>(wide >> 8));
        } else {
          pixels.push_back(static_cast<unsigned char>(std::lround(v)));
        }
      }
  if (tiled) {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 32);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, 16);
    std::vector<unsigned char> tile(static_cast<std::size_t>(32 * 16 * samples * bits / 8));
    const std::size_t row = pixels.size() / kHeight;
    for (std::size_t y = 0; y < kHeight; ++y)
      std::copy_n(pixels.begin() + static_cast<long>(y * row), row,
                  tile.begin() + static_cast<long>(y * tile.size() / 16));
    TIFFWriteTile(tiff, tile.data(), 0, 0, 0, 0);
  } else {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, kHeight);
    TIFFWriteEncodedStrip(tiff, 0, pixels.data(), static_cast<tmsize_t>(pixels.size()));
  }
  TIFFClose(tiff);
  const std::string content = file_content(file);
  fs::remove(file);
  return content;
}

std::string webp_of() {
  const auto rgb = rgb_pixels();
  std::uint8_t* data = nullptr;
  const std::size_t size = WebPEncodeLosslessRGB(rgb.data(), kWidth, kHeight, 3 * kWidth, &data);
  std::string out(reinterpret_cast<char*>(data), size);
  WebPFree(data);
  return out;
}

std::string webp_with_exif(int orientation) {
  std::string header(10, '\0');
  header[0] = 8;
  header[4] = kWidth - 1;
  header[7] = kHeight - 1;
  return webp_chunk("RIFF", "WEBP" + webp_chunk("VP8X", header) + webp_of().substr(12) +
                                webp_chunk("EXIF", exif(orientation)));
}

std::string cmyk_jpeg(bool adobe) {
  const auto rgb = rgb_pixels();
  std::vector<unsigned char> cmyk;
  for (std::size_t i = 0; i < kWidth * kHeight; ++i)
    for (std::size_t c = 0; c < 4; ++c) {
      const unsigned char v = c < 3 ? rgb[3 * i + c] : 255;
      cmyk.push_back(adobe ? v : static_cast<unsigned char>(255 - v));
    }
  const auto marked = [&](jpeg_compress_struct& info) {
    info.write_Adobe_marker = adobe ? TRUE : FALSE;
  };
  return written_jpeg(4, JCS_CMYK, cmyk, marked, [](jpeg_compress_struct&) {});
}

}  // namespace keyline::exchange::tests
