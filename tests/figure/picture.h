#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include <cairo.h>

#include <gtest/gtest.h>

namespace keyline::figure {

/// A PNG decoded by Cairo.
class Decoded {
 public:
  explicit Decoded(std::string_view png) {
    surface_.reset(cairo_image_surface_create_from_png_stream(read, &png));
  }
  bool valid() const { return cairo_surface_status(surface_.get()) == CAIRO_STATUS_SUCCESS; }
  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  int height() const { return cairo_image_surface_get_height(surface_.get()); }
  /// 0xRRGGBB.
  unsigned at(int x, int y) const {
    const unsigned char* row = cairo_image_surface_get_data(surface_.get()) +
                               std::ptrdiff_t{y} * cairo_image_surface_get_stride(surface_.get());
    std::uint32_t value = 0;
    std::memcpy(&value, row + std::ptrdiff_t{4} * x, 4);
    return value & 0xFFFFFFU;
  }
  /// Pixels that are not of this colour.
  int count_other_than(unsigned rgb) const {
    int count = 0;
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x) count += at(x, y) != rgb;
    return count;
  }

 private:
  static cairo_status_t read(void* source, unsigned char* bytes, unsigned count) {
    auto& rest = *static_cast<std::string_view*>(source);
    if (rest.size() < count) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(bytes, rest.data(), count);
    rest.remove_prefix(count);
    return CAIRO_STATUS_SUCCESS;
  }
  struct Deleter {
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  };
  std::unique_ptr<cairo_surface_t, Deleter> surface_;
};

}  // namespace keyline::figure
