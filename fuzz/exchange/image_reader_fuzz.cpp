// The reader of pictures: any bytes give an image that is as large as it says or a failure with a
// reason, never a crash.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "keyline/exchange/image/image_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto image =
      keyline::exchange::read_image(std::string_view(reinterpret_cast<const char*>(data), size));
  if (!image) return image.error().message.empty() ? std::abort(), 0 : 0;
  const auto pixels =
      static_cast<std::size_t>(image->width()) * static_cast<std::size_t>(image->height());
  if (image->luminance.data.size() != pixels || pixels == 0) std::abort();
  return 0;
}
