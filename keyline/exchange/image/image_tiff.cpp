#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <vector>

#include <tiffio.h>

#include "keyline/exchange/image/image_reader.h"

namespace keyline::exchange::detail {
namespace {

using core::Result;
using sketch::Image;

struct Source {
  std::string_view bytes;
  toff_t at = 0;
};

tmsize_t read_bytes(thandle_t handle, void* out, tmsize_t count) {
  auto& s = *static_cast<Source*>(handle);
  if (s.at >= s.bytes.size()) return 0;
  const auto n = std::min<toff_t>(static_cast<toff_t>(count), s.bytes.size() - s.at);
  std::memcpy(out, s.bytes.data() + s.at, n);
  s.at += n;
  return static_cast<tmsize_t>(n);
}

tmsize_t write_nothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  auto& s = *static_cast<Source*>(handle);
  s.at = whence == SEEK_SET ? offset : whence == SEEK_CUR ? s.at + offset : s.bytes.size() + offset;
  return s.at;
}

int close_nothing(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) { return static_cast<Source*>(handle)->bytes.size(); }
/// The bytes are in memory already: libtiff reads them in place (and never writes, mode "r").
int map_bytes(thandle_t handle, void** base, toff_t* size) {
  const std::string_view bytes = static_cast<Source*>(handle)->bytes;
  *base = const_cast<char*>(bytes.data());
  *size = bytes.size();
  return 1;
}
void unmap_nothing(thandle_t, void*, toff_t) {}

struct Closer {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};

/// libtiff reports through handlers of the whole process; ours keep quiet.
void silence() {
  static const bool kDone = [] {
    TIFFSetErrorHandler(nullptr);
    TIFFSetWarningHandler(nullptr);
    return true;
  }();
  (void)kDone;
}

struct Layout {
  std::uint16_t bits = 1;
  std::uint16_t samples = 1;
  std::uint16_t photometric = PHOTOMETRIC_MINISWHITE;
  std::uint16_t planar = PLANARCONFIG_CONTIG;
  std::uint16_t orientation = 1;
  bool tiled = false;
};

Layout layout_of(TIFF* tiff) {
  Layout l;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &l.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &l.samples);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &l.photometric);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &l.planar);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &l.orientation);
  l.tiled = TIFFIsTiled(tiff) != 0;
  return l;
}

/// 16 bit pictures are read at full depth; libtiff's own conversion gives 8 bits.
bool is_deep(const Layout& l) {
  const bool grey =
      l.photometric == PHOTOMETRIC_MINISBLACK || l.photometric == PHOTOMETRIC_MINISWHITE;
  const bool known = (grey && l.samples <= 2) ||
                     (l.photometric == PHOTOMETRIC_RGB && (l.samples == 3 || l.samples == 4));
  return l.bits == 16 && known && l.planar == PLANARCONFIG_CONTIG;
}

/// `count` pixels of 16 bit samples to those of the image from `at` on.
void convert(const std::uint16_t* p, const Layout& l, int count, Image& image, std::size_t at) {
  for (int x = 0; x < count; ++x, p += l.samples) {
    double v = l.samples >= 3 ? luminance(p[0], p[1], p[2]) : p[0];
    if (l.photometric == PHOTOMETRIC_MINISWHITE) v = 65535 - v;
    const bool alpha = l.samples == 2 || l.samples == 4;
    const double opacity = alpha ? p[l.samples - 1] / 65535.0 : 1;
    lay(image, at + static_cast<std::size_t>(x), v * opacity, opacity);
  }
}

bool read_deep_rows(TIFF* tiff, const Layout& l, Image& image) {
  const auto size = static_cast<std::size_t>(TIFFScanlineSize(tiff));
  if (size < 2U * l.samples * static_cast<std::size_t>(image.width())) return false;
  std::vector<std::uint16_t> row(size / 2 + 1);
  for (int y = 0; y < image.height(); ++y) {
    if (TIFFReadScanline(tiff, row.data(), static_cast<std::uint32_t>(y)) < 0) return false;
    convert(row.data(), l, image.width(), image, image.luminance.index(0, y));
  }
  return true;
}

bool read_deep_tiles(TIFF* tiff, const Layout& l, Image& image) {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
  const auto size = static_cast<std::size_t>(TIFFTileSize(tiff));
  const double wanted = 2.0 * l.samples * width * height;
  if (width == 0 || height == 0 || wanted > 1e9 || static_cast<double>(size) < wanted) return false;
  std::vector<std::uint16_t> tile(size / 2 + 1);
  const auto w = static_cast<std::uint32_t>(image.width());
  const auto h = static_cast<std::uint32_t>(image.height());
  for (std::uint32_t y = 0; y < h; y += height)
    for (std::uint32_t x = 0; x < w; x += width) {
      if (TIFFReadTile(tiff, tile.data(), x, y, 0, 0) < 0) return false;
      for (std::uint32_t row = 0; row < std::min(height, h - y); ++row)
        convert(tile.data() + static_cast<std::size_t>(row) * width * l.samples, l,
                static_cast<int>(std::min(width, w - x)), image,
                image.luminance.index(static_cast<int>(x), static_cast<int>(y + row)));
    }
  return true;
}

bool read_deep(TIFF* tiff, const Layout& l, Image& image) {
  return l.tiled ? read_deep_tiles(tiff, l, image) : read_deep_rows(tiff, l, image);
}

/// Through libtiff's conversion to RGBA (premultiplied), top row first, as the file orders rows.
bool read_converted(TIFF* tiff, Image& image) {
  char why[1024] = "";
  if (!TIFFRGBAImageOK(tiff, why)) return false;
  TIFFRGBAImage converter;
  if (!TIFFRGBAImageBegin(&converter, tiff, 1, why)) return false;
  converter.req_orientation = converter.orientation;  // rows as they stand; turned later
  const auto w = static_cast<std::uint32_t>(image.width());
  const auto h = static_cast<std::uint32_t>(image.height());
  std::vector<std::uint32_t> pixels(image.luminance.data.size());
  const bool good = TIFFRGBAImageGet(&converter, pixels.data(), w, h) != 0;
  TIFFRGBAImageEnd(&converter);
  for (std::size_t i = 0; good && i < pixels.size(); ++i) {
    const std::uint32_t p = pixels[i];
    lay(image, i, luminance(TIFFGetR(p) * 257, TIFFGetG(p) * 257, TIFFGetB(p) * 257),
        TIFFGetA(p) / 255.0);
  }
  return good;
}

double density(TIFF* tiff) {
  float resolution = 0;
  std::uint16_t unit = RESUNIT_INCH;
  if (!TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &resolution)) return 0;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_RESOLUTIONUNIT, &unit);
  if (!(resolution > 0) || unit == RESUNIT_NONE) return 0;
  return unit == RESUNIT_CENTIMETER ? resolution / 10.0 : resolution / 25.4;
}

/// Pictures behind the current one; smaller copies of it are none.
std::size_t further_pages(TIFF* tiff) {
  constexpr std::size_t kMost = 10'000;
  std::size_t pages = 0;
  while (pages < kMost && TIFFReadDirectory(tiff) != 0) {
    std::uint32_t type = 0;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SUBFILETYPE, &type);
    if ((type & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) == 0) ++pages;
  }
  return pages;
}

}  // namespace

Result<Image> read_tiff(std::string_view bytes) {
  silence();
  Source source{bytes, 0};
  const std::unique_ptr<TIFF, Closer> tiff(TIFFClientOpen("picture", "r", &source, read_bytes,
                                                          write_nothing, seek, close_nothing,
                                                          size_of, map_bytes, unmap_nothing));
  if (!tiff) return damaged("its TIFF directory cannot be read");
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  const Layout layout = layout_of(tiff.get());
  if (layout.bits > 16)
    return core::fail(core::ErrorCode::unsupported,
                      "the TIFF picture has " + std::to_string(layout.bits) + " bits per sample",
                      "save it with 8 or 16");
  // fax and deflate pack a thousandfold at the best
  const double raw = static_cast<double>(width) * height * layout.bits * layout.samples / 8;
  auto image = new_image(width, height, raw / 4000, bytes.size());
  if (!image) return image;
  const bool good =
      is_deep(layout) ? read_deep(tiff.get(), layout, *image) : read_converted(tiff.get(), *image);
  if (!good) return damaged("its TIFF pixels cannot be decoded");
  image->pixels_per_mm = density(tiff.get());
  image->further_pages = further_pages(tiff.get());
  apply_orientation(*image, layout.orientation);
  return image;
}

}  // namespace keyline::exchange::detail
