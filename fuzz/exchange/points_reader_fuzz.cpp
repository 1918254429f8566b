// The reader of point files: any bytes give curves or a failure, never a crash, and a curve that
// comes back holds as many points as it has source lines.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "keyline/exchange/points/points_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  const auto curves = keyline::exchange::read_points(in, "fuzz");
  if (!curves) return curves.error().message.empty() ? std::abort(), 0 : 0;
  for (const auto& curve : *curves) {
    if (curve.points.size() != curve.source_lines.size()) std::abort();
  }
  return 0;
}
