// The reader of offset tables: any bytes give curves of finite points or a failure.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "keyline/exchange/points/hull_table.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto table = keyline::exchange::read_hull_csv({reinterpret_cast<const char*>(data), size});
  if (!table) return table.error().message.empty() ? std::abort(), 0 : 0;
  for (const auto& named : keyline::exchange::hull_document(*table).space_curves)
    if (!validate(named.curve)) std::abort();
  return 0;
}
