#include "keyline/exchange/image_reader.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <jpeglib.h>
#include <png.h>
#include <tiffio.h>
#include <unistd.h>
#include <webp/encode.h>

#include <gtest/gtest.h>

#include "keyline/numeric/random.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 24;
constexpr int kHeight = 16;

/// Red grows to the right, green downwards: every place has its own luminance.
std::vector<unsigned char> rgb_pixels() {
  std::vector<unsigned char> pixels;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (const int v : {10 * x, 15 * y, 100}) pixels.push_back(static_cast<unsigned char>(v));
  return pixels;
}

double expected(int x, int y) { return 257 * (0.299 * 10 * x + 0.587 * 15 * y + 0.114 * 100); }

void expect_pixels(const core::Result<sketch::Image>& image, double tolerance) {
  ASSERT_TRUE(image) << image.error().message;
  ASSERT_EQ(image->width(), kWidth);
  ASSERT_EQ(image->height(), kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      ASSERT_NEAR(image->luminance.at(x, y), expected(x, y), tolerance) << x << ", " << y;
}

/// An EXIF block that states nothing but the orientation.
std::string exif(int orientation) {
  std::string e("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0", 19);
  e += static_cast<char>(orientation);
  e += std::string(6, '\0');
  return e;
}

std::string png_of(int color_type, int depth, const std::vector<unsigned char>& bytes, int width,
                   int height, bool interlaced = false, int orientation = 0) {
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

std::string jpeg_of(const std::vector<unsigned char>& rgb, int orientation = 0) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &data, &size);
  info.image_width = kWidth;
  info.image_height = kHeight;
  info.input_components = 3;
  info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 100, TRUE);
  info.density_unit = 1;
  info.X_density = info.Y_density = 254;
  jpeg_start_compress(&info, TRUE);
  if (orientation > 0) {
    const std::string marker = std::string("Exif\0\0", 6) + exif(orientation);
    jpeg_write_marker(&info, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(marker.data()),
                      static_cast<unsigned>(marker.size()));
  }
  while (info.next_scanline < info.image_height) {
    JSAMPROW row = const_cast<unsigned char*>(rgb.data()) + 3 * kWidth * info.next_scanline;
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  std::string out(reinterpret_cast<char*>(data), size);
  jpeg_destroy_compress(&info);
  std::free(data);
  return out;
}

std::string file_content(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::string tiff_of(int bits, int samples, int orientation, bool tiled = false) {
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

std::string webp_chunk(const char* name, std::string data) {
  std::string out(name);
  for (int k = 0; k < 4; ++k) out += static_cast<char>(data.size() >> 8 * k & 255);
  if (data.size() % 2 == 1) data += '\0';
  return out + data;
}

/// The extended form: a header chunk, the pixels, EXIF.
std::string webp_with_exif(int orientation) {
  std::string header(10, '\0');
  header[0] = 8;
  header[4] = kWidth - 1;
  header[7] = kHeight - 1;
  return webp_chunk("RIFF", "WEBP" + webp_chunk("VP8X", header) + webp_of().substr(12) +
                                webp_chunk("EXIF", exif(orientation)));
}

/// Pixels of the test picture as inks, with or without the marker that says they are inverted.
std::string cmyk_jpeg(bool adobe) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &data, &size);
  info.image_width = kWidth;
  info.image_height = kHeight;
  info.input_components = 4;
  info.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 100, TRUE);
  info.write_Adobe_marker = adobe ? TRUE : FALSE;
  jpeg_start_compress(&info, TRUE);
  const auto rgb = rgb_pixels();
  std::vector<unsigned char> line(4 * kWidth);
  for (std::size_t y = 0; y < kHeight; ++y) {
    for (std::size_t x = 0; x < kWidth; ++x)
      for (std::size_t c = 0; c < 4; ++c) {
        const unsigned char v = c < 3 ? rgb[3 * (y * kWidth + x) + c] : 255;
        line[4 * x + c] = adobe ? v : static_cast<unsigned char>(255 - v);
      }
    JSAMPROW row = line.data();
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  std::string out(reinterpret_cast<char*>(data), size);
  jpeg_destroy_compress(&info);
  std::free(data);
  return out;
}

TEST(ImageReader, ReadsInks) {
  for (const bool adobe : {true, false}) {
    SCOPED_TRACE(adobe);
    expect_pixels(read_image(cmyk_jpeg(adobe)), 1100);
  }
}

TEST(ImageReader, ReadsEveryFormatAndDepth) {
  const auto rgb = rgb_pixels();
  expect_pixels(read_image(png_of(PNG_COLOR_TYPE_RGB, 8, rgb, kWidth, kHeight)), 300);
  expect_pixels(read_image(png_of(PNG_COLOR_TYPE_RGB, 8, rgb, kWidth, kHeight, true)), 300);
  expect_pixels(read_image(jpeg_of(rgb)), 1100);
  expect_pixels(read_image(webp_of()), 2);
  for (const bool tiled : {false, true})
    for (const int samples : {1, 3}) {
      expect_pixels(read_image(tiff_of(8, samples, 1, tiled)), 300);
      expect_pixels(read_image(tiff_of(16, samples, 1, tiled)), 140);
    }
}

TEST(ImageReader, TellsTheResolution) {
  const auto rgb = rgb_pixels();
  EXPECT_NEAR(read_image(png_of(PNG_COLOR_TYPE_RGB, 8, rgb, kWidth, kHeight))->pixels_per_mm, 4,
              1e-9);
  EXPECT_NEAR(read_image(jpeg_of(rgb))->pixels_per_mm, 10, 1e-9);
  EXPECT_NEAR(read_image(tiff_of(8, 3, 1))->pixels_per_mm, 300 / 25.4, 1e-6);
}

TEST(ImageReader, LaysTransparencyOverWhite) {
  std::vector<unsigned char> rgba(16);
  for (std::size_t i = 0; i < 4; ++i) rgba[4 * i + 3] = static_cast<unsigned char>(85 * i);
  const auto image = read_image(png_of(PNG_COLOR_TYPE_RGBA, 8, rgba, 4, 1));
  ASSERT_TRUE(image);
  for (int x = 0; x < 4; ++x) EXPECT_NEAR(image->luminance.at(x, 0), 65535 - 65535.0 * x / 3, 300);
}

TEST(ImageReader, KeepsSixteenBits) {
  std::vector<unsigned char> grey(16);
  for (std::size_t i = 0; i < 8; ++i) {
    grey[2 * i] = static_cast<unsigned char>(i * 30);
    grey[2 * i + 1] = static_cast<unsigned char>(i * 17);
  }
  const auto image = read_image(png_of(PNG_COLOR_TYPE_GRAY, 16, grey, 8, 1));
  ASSERT_TRUE(image);
  for (int x = 0; x < 8; ++x) EXPECT_EQ(image->luminance.at(x, 0), 256 * 30 * x + 17 * x);
}

TEST(ImageReader, TurnsPicturesUpright) {
  // where pixel (x, y) of the stored picture is to be seen, by the EXIF standard
  struct Case {
    int orientation;
    bool turned;
    int (*column)(int, int);
    int (*row)(int, int);
  };
  static constexpr Case kCases[] = {
      {1, false, [](int x, int) { return x; }, [](int, int y) { return y; }},
      {2, false, [](int x, int) { return kWidth - 1 - x; }, [](int, int y) { return y; }},
      {3, false, [](int x, int) { return kWidth - 1 - x; },
       [](int, int y) { return kHeight - 1 - y; }},
      {4, false, [](int x, int) { return x; }, [](int, int y) { return kHeight - 1 - y; }},
      {5, true, [](int, int y) { return y; }, [](int x, int) { return x; }},
      {6, true, [](int, int y) { return kHeight - 1 - y; }, [](int x, int) { return x; }},
      {7, true, [](int, int y) { return kHeight - 1 - y; },
       [](int x, int) { return kWidth - 1 - x; }},
      {8, true, [](int, int y) { return y; }, [](int x, int) { return kWidth - 1 - x; }},
  };
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.orientation);
    for (const auto& bytes :
         {jpeg_of(rgb_pixels(), c.orientation), tiff_of(16, 3, c.orientation),
          tiff_of(8, 3, c.orientation), webp_with_exif(c.orientation),
          png_of(PNG_COLOR_TYPE_RGB, 8, rgb_pixels(), kWidth, kHeight, false, c.orientation)}) {
      const auto image = read_image(bytes);
      ASSERT_TRUE(image) << image.error().message;
      ASSERT_EQ(image->width(), c.turned ? kHeight : kWidth);
      for (const auto& [x, y] : {std::pair{2, 3}, {20, 3}, {5, 14}})
        EXPECT_NEAR(image->luminance.at(c.column(x, y), c.row(x, y)), expected(x, y), 1100);
    }
  }
}

void expect_bad(const std::string& bytes) {
  const auto image = read_image(bytes);
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, core::ErrorCode::bad_input);
  EXPECT_FALSE(image.error().message.empty());
  EXPECT_EQ(image.error().message.find('\n'), std::string::npos);
}

TEST(ImageReader, RefusesTruncatedFiles) {
  const auto rgb = rgb_pixels();
  for (const std::string& whole : {png_of(PNG_COLOR_TYPE_RGB, 8, rgb, kWidth, kHeight),
                                   jpeg_of(rgb), webp_of(), tiff_of(8, 3, 1), tiff_of(16, 1, 1)})
    for (const double share : {0.05, 0.2, 0.5, 0.9}) {
      SCOPED_TRACE(std::to_string(whole.size()) + " bytes, share " + std::to_string(share));
      expect_bad(
          whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    }
}

TEST(ImageReader, SurvivesCorruptBytes) {
  const auto rgb = rgb_pixels();
  numeric::Random random(11);
  for (const std::string& whole : {png_of(PNG_COLOR_TYPE_RGB, 8, rgb, kWidth, kHeight),
                                   jpeg_of(rgb, 6), webp_of(), tiff_of(8, 3, 1), tiff_of(16, 3, 5)})
    for (int round = 0; round < 300; ++round) {
      std::string bytes = whole;
      for (int k = 0; k < 4; ++k)
        bytes[random.index(bytes.size())] = static_cast<char>(random.bits());
      const auto image = read_image(bytes);
      EXPECT_TRUE(image || !image.error().message.empty());
    }
}

void put(std::string& bytes, std::size_t at, std::uint32_t value, int size, bool little) {
  for (int k = 0; k < size; ++k)
    bytes[at + static_cast<std::size_t>(k)] =
        static_cast<char>(value >> (8 * (little ? k : size - 1 - k)));
}

TEST(ImageReader, RefusesHeaderBombsBeforeMakingRoom) {
  const auto rgb = rgb_pixels();
  std::string jpeg = jpeg_of(rgb);
  const std::size_t frame = jpeg.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  put(jpeg, frame + 5, 40000, 2, false);
  put(jpeg, frame + 7, 40000, 2, false);
  expect_bad(jpeg);
  std::string tiff = tiff_of(8, 1, 1);
  const auto number = [&](std::size_t at, int size) {
    std::uint32_t v = 0;
    for (int k = size; k-- > 0;)
      v = v << 8 | static_cast<unsigned char>(tiff[at + static_cast<std::size_t>(k)]);
    return v;
  };
  const std::size_t directory = number(4, 4);
  for (std::size_t k = 0; k < number(directory, 2); ++k) {
    const std::size_t entry = directory + 2 + 12 * k;
    if (number(entry, 2) == TIFFTAG_IMAGEWIDTH || number(entry, 2) == TIFFTAG_IMAGELENGTH) {
      put(tiff, entry + 2, 4, 2, true);
      put(tiff, entry + 8, 40000, 4, true);
    }
  }
  expect_bad(tiff);
  // a PNG with a good checksum that states 40,000 × 40,000, and one within the limit but empty
  for (const int side : {40000, 8000}) {
    std::string png = png_of(PNG_COLOR_TYPE_RGB, 8, rgb, kWidth, kHeight);
    put(png, 16, static_cast<std::uint32_t>(side), 4, false);
    put(png, 20, static_cast<std::uint32_t>(side), 4, false);
    std::uint32_t crc = 0xffffffff;
    for (std::size_t i = 12; i < 29; ++i) {
      crc ^= static_cast<unsigned char>(png[i]);
      for (int k = 0; k < 8; ++k) crc = crc & 1 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
    }
    put(png, 29, ~crc, 4, false);
    expect_bad(png);
  }
}

TEST(ImageReader, RefusesWhatIsNoPicture) {
  expect_bad("");
  expect_bad("just text in a file named .png\n");
  expect_bad(std::string("\x89PNG\r\n\x1a\n", 8));
  expect_bad(std::string("II*\0", 4));
  expect_bad(std::string("RIFF") + std::string(4, '\0') + "WEBP");
  const auto folder = read_image_file(fs::temp_directory_path());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code, core::ErrorCode::io);
  const auto absent = read_image_file("/no/such/picture.png");
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, core::ErrorCode::io);
}

TEST(ImageReader, HostilePngFiles) {
  const fs::path folder = fs::path(KEYLINE_SHARED_DATA) / "4_cad/nasty/png";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "no " << folder;
  for (const char* bad :
       {"badadler.png", "badcrc.png", "huge_eXIf_chunk.png", "huge_tEXt_chunk.png"}) {
    SCOPED_TRACE(bad);
    expect_bad(file_content(folder / bad));
  }
  for (const char* good : {"basn0g01.png", "basn3p02.png", "basn4a16.png", "ibasn6a08.png",
                           "gray-16-linear.png", "empty_ancillary_chunks.png"}) {
    SCOPED_TRACE(good);
    EXPECT_TRUE(read_image(file_content(folder / good)));
  }
}

TEST(ImageReader, KnowsPicturesByName) {
  for (const char* name : {"a.png", "b.JPG", "c.jpeg", "d.Tif", "e.tiff", "f.webp"})
    EXPECT_TRUE(has_image_name(name));
  for (const char* name : {"a.svg", "png", "b.csv", ""}) EXPECT_FALSE(has_image_name(name));
}

}  // namespace
}  // namespace keyline::exchange
