#include "keyline/exchange/points/points_kind.h"

#include "keyline/exchange/file/standard_stream.h"

namespace keyline::exchange::detail {

core::Result<void> check_kind(const std::string& file) {
  if (extension_of(file) != ".ptx") return {};
  return core::fail(core::ErrorCode::bad_input,
                    "a scan in PTX: its points are placed by a matrix before them, which is not "
                    "read",
                    "convert it to PTS, XYZ or PLY", file);
}

}  // namespace keyline::exchange::detail
