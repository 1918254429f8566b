// The reader of SVG: any bytes give curves of finite points or a failure.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "keyline/core/point.h"
#include "keyline/exchange/svg/svg_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  keyline::exchange::SvgReadLimits limits;
  limits.memory = std::size_t{1} << 20;
  limits.elements = 20'000;
  const auto contents =
      keyline::exchange::read_svg({reinterpret_cast<const char*>(data), size}, limits);
  if (!contents) {
    if (contents.error().message.empty()) std::abort();
    return 0;
  }
  for (const auto& curve : contents->curves) {
    for (const auto& piece : curve.pieces) {
      for (const auto& p : piece.control) {
        if (!keyline::core::is_finite(p)) std::abort();
      }
    }
  }
  return 0;
}
