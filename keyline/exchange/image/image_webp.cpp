#include <algorithm>
#include <cstdint>
#include <vector>

#include <webp/decode.h>

#include "keyline/exchange/image/image_reader.h"

namespace keyline::exchange::detail {
namespace {

/// Content of the RIFF chunk of that name, empty where there is none.
std::string_view chunk(std::string_view bytes, std::string_view name) {
  std::size_t at = 12;
  while (at + 8 <= bytes.size()) {
    std::size_t size = 0;
    for (std::size_t k = 4; k-- > 0;)
      size = size << 8 | static_cast<unsigned char>(bytes[at + 4 + k]);
    if (bytes.substr(at, 4) == name) return bytes.substr(at + 8, size);
    at += 8 + size + size % 2;
  }
  return {};
}

}  // namespace

core::Result<sketch::Image> read_webp(std::string_view bytes) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
    return damaged("its WebP header cannot be read");
  if (features.has_animation)
    return core::fail(core::ErrorCode::unsupported, "the WebP picture is an animation",
                      "save one frame of it");
  // a macroblock of 16 x 16 pixels may take a tenth of a bit, no less
  const double blocks = features.width / 16.0 * features.height / 16.0;
  auto image = new_image(features.width, features.height, blocks / 800, bytes.size());
  if (!image) return image;
  std::vector<std::uint8_t> pixels(4 * image->luminance.data.size());
  if (!WebPDecodeRGBAInto(data, bytes.size(), pixels.data(), pixels.size(), 4 * features.width))
    return damaged("its WebP pixels cannot be decoded");
  for (std::size_t i = 0; i < image->luminance.data.size(); ++i) {
    const std::uint8_t* p = pixels.data() + 4 * i;
    const double opacity = p[3] / 255.0;
    lay(*image, i, luminance(p[0] * 257.0, p[1] * 257.0, p[2] * 257.0) * opacity, opacity);
  }
  apply_orientation(*image, exif_orientation(chunk(bytes, "EXIF")));
  return image;
}

}  // namespace keyline::exchange::detail
