// The reader of documents as JSON: any bytes give valid curves and surfaces or a failure.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "keyline/exchange/json/json_document.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto document = keyline::exchange::read_json({reinterpret_cast<const char*>(data), size});
  if (!document) return document.error().message.empty() ? std::abort(), 0 : 0;
  for (const auto& named : document->paths)
    if (!validate(named.path)) std::abort();
  for (const auto& named : document->space_curves)
    if (!validate(named.curve)) std::abort();
  for (const auto& named : document->surfaces)
    if (!validate(named.surface)) std::abort();
  return 0;
}
