#pragma once

#include <string>

namespace keyline::exchange::detail {

/// A unit of $INSUNITS: ours, and how many of ours one of it is.
struct DxfUnit {
  int code = 0;
  const char* name = "";
  double factor = 1;
};

/// Null for a code DXF does not define, or one of astronomy.
const DxfUnit* dxf_unit_of(int code);

/// $INSUNITS of a unit of ours; 0 (none) where DXF has none such.
int dxf_unit(const std::string& unit);

}  // namespace keyline::exchange::detail
