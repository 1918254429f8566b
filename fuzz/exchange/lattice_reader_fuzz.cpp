// The reader of lattices: any bytes give a full grid or a failure.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "keyline/exchange/points/lattice_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  const auto lattice = keyline::exchange::read_lattice(in, "fuzz");
  if (!lattice && lattice.error().message.empty()) std::abort();
  if (lattice && lattice->lattice.points.size() != lattice->lattice.rows * lattice->lattice.columns)
    std::abort();
  return 0;
}
