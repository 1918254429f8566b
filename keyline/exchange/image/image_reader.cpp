#include "keyline/exchange/image/image_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/file/standard_stream.h"
#include "keyline/exchange/format/format.h"

namespace keyline::exchange {

using core::ErrorCode;
using core::Result;
using sketch::Image;

namespace {

bool starts_with(std::string_view bytes, std::string_view magic) {
  return bytes.substr(0, magic.size()) == magic;
}

/// Little or big endian numbers of a TIFF structure, 0 beyond the end.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes), little_(starts_with(bytes, "II")) {}
  std::uint32_t number(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || bytes_.size() - at < size) return 0;
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t i = little_ ? at + size - 1 - k : at + k;
      value = value << 8 | static_cast<unsigned char>(bytes_[i]);
    }
    return value;
  }

 private:
  std::string_view bytes_;
  bool little_;
};

/// Copies pixels to where `place` says, into an image of that size.
template <class Place>
void rearrange(Image& image, int width, int height, const Place& place) {
  for (auto* levels : {&image.luminance, &image.over_black}) {
    if (levels->data.empty()) continue;
    sketch::Raster<std::uint16_t> turned(width, height);
    for (int y = 0; y < levels->height; ++y)
      for (int x = 0; x < levels->width; ++x) {
        const auto [u, v] = place(x, y);
        turned.at(u, v) = levels->at(x, y);
      }
    *levels = std::move(turned);
  }
}

constexpr std::uint16_t kMidGrey = 32768;

bool is_dark(std::uint16_t level) { return level < kMidGrey; }

/// A picture on the grounds that show what is drawn. If on black most but not all of it is dark,
/// light is drawn on a transparent ground: it stays on black if nothing is dark on white, else on
/// both.
Result<Image> on_its_ground(Result<Image> image) {
  if (!image || image->over_black.data.empty()) return image;
  auto& black = image->over_black;
  const std::size_t all = black.data.size();
  const auto dark = static_cast<std::size_t>(std::ranges::count_if(black.data, is_dark));
  const bool light_drawn = 2 * dark > all && dark < all;
  if (light_drawn && std::ranges::any_of(image->luminance.data, is_dark)) return image;
  if (light_drawn) {
    image->luminance = std::move(black);
    image->on_black = true;
  }
  black = {};
  return image;
}

std::uint16_t level(double v) {
  return static_cast<std::uint16_t>(std::clamp(std::lround(v), 0L, 65535L));
}

}  // namespace

namespace detail {

std::unexpected<core::Failure> damaged(const std::string& what) {
  return core::fail(ErrorCode::bad_input, "the picture is damaged: " + what,
                    "save or export it again");
}

Result<Image> new_image(std::int64_t width, std::int64_t height, double least_bytes,
                        std::size_t bytes) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width <= 0 || height <= 0) return damaged("it states a size of " + size + " pixels");
  if (!sketch::is_allowed_size(width, height))
    return core::fail(ErrorCode::bad_input,
                      "the picture has " + size + " pixels; 64 megapixels are the most",
                      "make it smaller");
  if (least_bytes > static_cast<double>(bytes))
    return damaged("it is too short for the " + size + " pixels it states");
  Image image;
  image.luminance =
      sketch::Raster<std::uint16_t>(static_cast<int>(width), static_cast<int>(height));
  return image;
}

std::uint16_t luminance(double red, double green, double blue) {
  return level(0.299 * red + 0.587 * green + 0.114 * blue);
}

void lay(Image& image, std::size_t i, double v, double opacity) {
  auto& black = image.over_black;
  if (opacity < 1 && black.data.empty()) black = image.luminance;
  image.luminance.data[i] = level(v + 65535 * (1 - opacity));
  if (!black.data.empty()) black.data[i] = level(v);
}

int exif_orientation(std::string_view exif) {
  constexpr std::string_view kHead("Exif\0\0", 6);
  if (starts_with(exif, kHead)) exif.remove_prefix(kHead.size());
  if (!starts_with(exif, "II") && !starts_with(exif, "MM")) return 1;
  const Fields fields(exif);
  const std::size_t directory = fields.number(4, 4);
  const std::size_t count = fields.number(directory, 2);
  for (std::size_t k = 0; k < std::min<std::size_t>(count, 1000); ++k) {
    const std::size_t entry = directory + 2 + 12 * k;
    if (fields.number(entry, 2) != 0x0112) continue;
    const auto value = static_cast<int>(fields.number(entry + 8, 2));
    return value >= 1 && value <= 8 ? value : 1;
  }
  return 1;
}

void apply_orientation(Image& image, int orientation) {
  const int w = image.width();
  const int h = image.height();
  using Place = std::array<int, 2>;
  switch (orientation) {
    case 2:
      return rearrange(image, w, h, [=](int x, int y) { return Place{w - 1 - x, y}; });
    case 3:
      return rearrange(image, w, h, [=](int x, int y) { return Place{w - 1 - x, h - 1 - y}; });
    case 4:
      return rearrange(image, w, h, [=](int x, int y) { return Place{x, h - 1 - y}; });
    case 5:
      return rearrange(image, h, w, [=](int x, int y) { return Place{y, x}; });
    case 6:
      return rearrange(image, h, w, [=](int x, int y) { return Place{h - 1 - y, x}; });
    case 7:
      return rearrange(image, h, w, [=](int x, int y) { return Place{h - 1 - y, w - 1 - x}; });
    case 8:
      return rearrange(image, h, w, [=](int x, int y) { return Place{y, w - 1 - x}; });
    default:
      return;
  }
}

}  // namespace detail

bool has_image_name(const std::filesystem::path& path) {
  static constexpr std::array<std::string_view, 6> kNames = {".png", ".jpg",  ".jpeg",
                                                             ".tif", ".tiff", ".webp"};
  return std::find(kNames.begin(), kNames.end(), extension_of(path)) != kNames.end();
}

Result<Image> read_image(std::string_view bytes) {
  const std::string_view kind = picture_extension(bytes);
  if (kind == ".png") return on_its_ground(detail::read_png(bytes));
  if (kind == ".jpg") return detail::read_jpeg(bytes);
  if (kind == ".tif") return on_its_ground(detail::read_tiff(bytes));
  if (kind == ".webp") return on_its_ground(detail::read_webp(bytes));
  return core::fail(ErrorCode::bad_input, "is no PNG, JPEG, TIFF or WebP picture",
                    "save the drawing in one of these formats");
}

Result<Image> read_image_file(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return std::unexpected(bytes.error());
  auto image = read_image(*bytes);
  if (!image && image.error().path.empty()) image.error().path = path.string();
  return image;
}

}  // namespace keyline::exchange
