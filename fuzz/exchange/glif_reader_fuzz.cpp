// The reader of UFO glyphs: any bytes give valid curves or a failure.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "keyline/exchange/font/glif.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto glyph = keyline::exchange::read_glif({reinterpret_cast<const char*>(data), size});
  if (!glyph) return glyph.error().message.empty() ? std::abort(), 0 : 0;
  for (const auto& named : glyph->paths)
    if (!validate(named.path)) std::abort();
  return 0;
}
