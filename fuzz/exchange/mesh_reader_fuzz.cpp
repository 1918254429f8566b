// The readers of OBJ, STL and PLY: any bytes give triangles of known vertices or a failure, and
// whatever comes back can be cut.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "keyline/acquire/symmetry.h"
#include "keyline/exchange/mesh/mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace exchange = keyline::exchange;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const auto read : {&exchange::read_obj, &exchange::read_stl, &exchange::read_ply}) {
    const auto mesh = read(bytes);
    if (!mesh) {
      if (mesh.error().message.empty() || mesh.error().path.empty()) std::abort();
      continue;
    }
    for (const auto& triangle : mesh->triangles)
      for (const auto index : triangle)
        if (index >= mesh->points.size()) std::abort();
    for (const auto& line : section(*mesh, keyline::acquire::plane_of({0, 1, 0}, 0.25)))
      if (line.points.size() < 2) std::abort();
  }
  return 0;
}
