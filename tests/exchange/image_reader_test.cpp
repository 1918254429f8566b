#include "keyline/exchange/image/image_reader.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include <png.h>
#include <tiffio.h>

#include <gtest/gtest.h>

#include "keyline/numeric/random.h"

#include "picture_files.h"
#include "tests/shared_data.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using namespace tests;  // the test picture's files

void expect_pixels(const core::Result<sketch::Image>& image, double tolerance) {
  ASSERT_TRUE(image) << image.error().message;
  ASSERT_EQ(image->width(), kWidth);
  ASSERT_EQ(image->height(), kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      ASSERT_NEAR(image->luminance.at(x, y), expected(x, y), tolerance) << x << ", " << y;
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

// Of a file of several pages the first; a smaller copy of it is no page.
TEST(ImageReader, CountsThePagesBehindTheFirst) {
  const fs::path file = fs::temp_directory_path() / "keyline-pages.tif";
  TIFF* tiff = TIFFOpen(file.c_str(), "w");
  for (const std::uint32_t type : {0U, 0U, unsigned{FILETYPE_REDUCEDIMAGE}, 0U}) {
    unsigned char grey = type == 0 ? 200 : 10;
    TIFFSetField(tiff, TIFFTAG_SUBFILETYPE, type);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 1U);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1U);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFWriteEncodedStrip(tiff, 0, &grey, 1);
    TIFFWriteDirectory(tiff);
  }
  TIFFClose(tiff);
  const auto image = read_image(file_content(file));
  fs::remove(file);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->further_pages, 2U);
  EXPECT_EQ(image->luminance.at(0, 0), 200 * 257);
  EXPECT_EQ(read_image(tiff_of(8, 3, 1))->further_pages, 0U);
}

/// A TIFF of one row of 16 bit pixels with these samples.
std::string deep_tiff(const std::vector<std::uint16_t>& samples, int per_pixel, int photometric) {
  const fs::path file = fs::temp_directory_path() / "keyline-deep.tif";
  TIFF* tiff = TIFFOpen(file.c_str(), "w");
  const auto width = samples.size() / static_cast<std::size_t>(per_pixel);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(width));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1U);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 16);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, per_pixel);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, photometric);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  if (per_pixel % 2 == 0) {
    const std::uint16_t unassociated = EXTRASAMPLE_UNASSALPHA;
    TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &unassociated);
  }
  TIFFWriteEncodedStrip(tiff, 0, const_cast<std::uint16_t*>(samples.data()),
                        static_cast<tmsize_t>(2 * samples.size()));
  TIFFClose(tiff);
  const std::string content = file_content(file);
  fs::remove(file);
  return content;
}

// 0.299 r + 0.587 g + 0.114 b, and of what is not opaque the rest is white: by hand to a unit of 16
// bits, which no way of 8 bits meets.
TEST(ImageReader, DeepPicturesKeepTheirBitsAndAlpha) {
  const auto color = read_image(
      deep_tiff({1003, 20011, 40009, 65535, 1003, 20011, 40009, 0, 1003, 20011, 40009, 26214}, 4,
                PHOTOMETRIC_RGB));
  ASSERT_TRUE(color);
  const double v = 0.299 * 1003 + 0.587 * 20011 + 0.114 * 40009;
  EXPECT_NEAR(color->luminance.at(0, 0), v, 1);
  EXPECT_EQ(color->luminance.at(1, 0), 65535);
  EXPECT_NEAR(color->luminance.at(2, 0), 0.4 * v + 0.6 * 65535, 1);
  const auto grey = read_image(deep_tiff({1003, 65535, 1003, 13107}, 2, PHOTOMETRIC_MINISBLACK));
  ASSERT_TRUE(grey);
  EXPECT_NEAR(grey->luminance.at(0, 0), 1003, 1);
  EXPECT_NEAR(grey->luminance.at(1, 0), 0.2 * 1003 + 0.8 * 65535, 1);
  const auto white = read_image(deep_tiff({1003, 40009}, 1, PHOTOMETRIC_MINISWHITE));
  ASSERT_TRUE(white);
  EXPECT_NEAR(white->luminance.at(0, 0), 65535 - 1003, 1);
  EXPECT_NEAR(white->luminance.at(1, 0), 65535 - 40009, 1);
  const auto plain = read_image(deep_tiff({1003, 20011, 40009}, 3, PHOTOMETRIC_RGB));
  ASSERT_TRUE(plain);
  EXPECT_NEAR(plain->luminance.at(0, 0), v, 1);
}

TEST(ImageReader, LaysTransparencyOverWhite) {
  std::vector<unsigned char> rgba(16);
  for (std::size_t i = 0; i < 4; ++i) rgba[4 * i + 3] = static_cast<unsigned char>(85 * i);
  const auto image = read_image(png_of(PNG_COLOR_TYPE_RGBA, 8, rgba, 4, 1));
  ASSERT_TRUE(image);
  for (int x = 0; x < 4; ++x) EXPECT_NEAR(image->luminance.at(x, 0), 65535 - 65535.0 * x / 3, 300);
}

// White on nothing is lost on white; a black pixel more, and both grounds are needed; less than
// half of nothing, and it is not what is drawn there that is light.
TEST(ImageReader, LaysLightLinesOnNothingOverBlack) {
  const auto picture = [](const std::vector<std::array<unsigned char, 2>>& pixels) {
    std::vector<unsigned char> bytes;  // of grey and opacity
    for (const auto& p : pixels) bytes.insert(bytes.end(), p.begin(), p.end());
    const auto image =
        read_image(png_of(PNG_COLOR_TYPE_GRAY_ALPHA, 8, bytes, static_cast<int>(pixels.size()), 1));
    EXPECT_TRUE(image);
    return image.value_or(sketch::Image{});
  };
  const auto light = picture({{0, 0}, {255, 51}, {255, 255}, {255, 0}, {0, 0}});
  EXPECT_TRUE(light.on_black);
  EXPECT_EQ(light.luminance.data, (std::vector<std::uint16_t>{0, 13107, 65535, 0, 0}));
  for (const auto& other :
       {picture({{0, 0}, {0, 255}, {0, 0}, {0, 0}}),
        picture({{0, 0}, {255, 255}, {255, 255}, {200, 255}, {0, 0}}), picture({{0, 0}, {0, 0}})}) {
    EXPECT_FALSE(other.on_black);
    EXPECT_EQ(other.luminance.data.front(), 65535);
    EXPECT_TRUE(other.over_black.data.empty());
  }
  const auto both = picture({{0, 0}, {255, 255}, {0, 255}, {0, 0}, {255, 51}});
  EXPECT_FALSE(both.on_black);
  EXPECT_EQ(both.luminance.data, (std::vector<std::uint16_t>{65535, 65535, 0, 65535, 65535}));
  EXPECT_EQ(both.over_black.data, (std::vector<std::uint16_t>{0, 65535, 0, 0, 13107}));
  const auto deep = read_image(
      deep_tiff({0, 0, 0, 0, 65535, 65535, 65535, 65535, 0, 0, 0, 0}, 4, PHOTOMETRIC_RGB));
  ASSERT_TRUE(deep);
  EXPECT_EQ(deep->luminance.data, (std::vector<std::uint16_t>{0, 65535, 0}));
}

// Both grounds of an interlaced picture that lies on its side, by hand: pixel (x, y) of 3 x 2 is
// seen at (1 - y, x).
TEST(ImageReader, KeepsBothGroundsInterlacedAndTurned) {
  const std::vector<unsigned char> bytes = {0, 0, 255, 255, 0, 255, 0, 0, 0, 0, 255, 51};
  const auto image = read_image(png_of(PNG_COLOR_TYPE_GRAY_ALPHA, 8, bytes, 3, 2, true, 6));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width(), 2);
  EXPECT_EQ(image->luminance.data,
            (std::vector<std::uint16_t>{65535, 65535, 65535, 65535, 65535, 0}));
  EXPECT_EQ(image->over_black.data, (std::vector<std::uint16_t>{0, 0, 0, 65535, 13107, 0}));
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

// Some programs write EXIF behind the pixels.
TEST(ImageReader, FindsPngOrientationBehindThePixels) {
  std::string bytes = png_of(PNG_COLOR_TYPE_RGB, 8, rgb_pixels(), kWidth, kHeight, false, 6);
  const std::size_t at = bytes.find("eXIf") - 4;
  const std::size_t size = 12 + static_cast<unsigned char>(bytes[at + 3]);
  const std::string chunk = bytes.substr(at, size);
  bytes.erase(at, size);
  bytes.insert(bytes.find("IEND") - 4, chunk);
  const auto image = read_image(bytes);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width(), kHeight);
  EXPECT_NEAR(image->luminance.at(kHeight - 1 - 3, 2), expected(2, 3), 300);
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

/// A TIFF of a few pixels that states side x side.
std::string tiff_stating(std::uint32_t side) {
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
      put(tiff, entry + 8, side, 4, true);
    }
  }
  return tiff;
}

// Deflate packs a thousandfold at the best: 8000 x 8000 pixels are not in a file of a kilobyte.
TEST(ImageReader, SaysWhereAFileIsTooShortForItsPixels) {
  const auto image = read_image(tiff_stating(8000));
  ASSERT_FALSE(image);
  EXPECT_NE(image.error().message.find("too short for the 8000 x 8000 pixels"), std::string::npos)
      << image.error().message;
}

TEST(ImageReader, RefusesHeaderBombsBeforeMakingRoom) {
  const auto rgb = rgb_pixels();
  std::string jpeg = jpeg_of(rgb);
  const std::size_t frame = jpeg.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  put(jpeg, frame + 5, 40000, 2, false);
  put(jpeg, frame + 7, 40000, 2, false);
  expect_bad(jpeg);
  expect_bad(tiff_stating(40000));
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

TEST(ImageReader, RefusesPicturesWithoutPixels) {
  EXPECT_TRUE(detail::new_image(3, 2, 6, 6));
  for (const auto& [width, height] : {std::pair{3, 0}, {0, 3}, {-1, 3}, {3, -1}}) {
    const auto image = detail::new_image(width, height, 0, 6);
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find(std::to_string(width) + " x " + std::to_string(height)),
              std::string::npos);
    EXPECT_NE(image.error().message.find("damaged"), std::string::npos);
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
  KEYLINE_NEEDS_SHARED_DATA(fs::is_directory(folder), folder);
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
