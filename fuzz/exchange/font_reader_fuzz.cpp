// The reader of fonts: any bytes give valid outlines or a failure.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "keyline/exchange/font/font.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const auto* wanted : {"Sa", "/a", "U+0053"}) {
    const auto font = keyline::exchange::read_font(bytes, wanted);
    if (!font) {
      if (font.error().message.empty()) std::abort();
      continue;
    }
    for (const auto& named : font->paths)
      if (!validate(named.path)) std::abort();
  }
  return 0;
}
