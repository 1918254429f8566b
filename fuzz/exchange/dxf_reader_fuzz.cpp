// The reader of DXF: any bytes give valid curves or a failure.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "keyline/exchange/dxf/dxf_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const keyline::exchange::DxfReadLimits limits{.depth = 8, .points = 2'000, .curves = 2'000};
  const auto document =
      keyline::exchange::read_dxf({reinterpret_cast<const char*>(data), size}, limits);
  if (!document) return document.error().message.empty() ? std::abort(), 0 : 0;
  for (const auto& named : document->paths)
    for (const auto& curve : named.path.curves)
      if (!validate(curve)) std::abort();
  for (const auto& named : document->space_curves)
    if (!validate(named.curve)) std::abort();
  return 0;
}
