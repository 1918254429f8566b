// The reader of pen strokes: any bytes give strokes with points or a failure, never a crash.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "keyline/exchange/points/scap_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto drawing =
      keyline::exchange::read_scap(std::string_view(reinterpret_cast<const char*>(data), size));
  if (!drawing) return drawing.error().message.empty() ? std::abort(), 0 : 0;
  for (const auto& stroke : drawing->strokes)
    if (stroke.points.empty()) std::abort();
  return 0;
}
