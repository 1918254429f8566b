#include "keyline/exchange/dxf/dxf_units.h"

#include <algorithm>
#include <array>

namespace keyline::exchange::detail {
namespace {

constexpr double kSurveyFoot = 1200.0 / 3937 / 0.3048;  // US survey foot in international feet

/// The first of a name is what it is written as.
constexpr std::array<DxfUnit, 18> kUnits = {{{0, "", 1},
                                             {1, "in", 1},
                                             {2, "ft", 1},
                                             {3, "ft", 5280},
                                             {4, "mm", 1},
                                             {5, "cm", 1},
                                             {6, "m", 1},
                                             {7, "km", 1},
                                             {8, "in", 1e-6},
                                             {9, "in", 1e-3},
                                             {10, "ft", 3},
                                             {11, "mm", 1e-7},
                                             {12, "mm", 1e-6},
                                             {13, "mm", 1e-3},
                                             {14, "cm", 10},
                                             {15, "m", 10},
                                             {16, "m", 100},
                                             {21, "ft", kSurveyFoot}}};

}  // namespace

const DxfUnit* dxf_unit_of(int code) {
  const auto found = std::find_if(kUnits.begin(), kUnits.end(),
                                  [code](const DxfUnit& unit) { return unit.code == code; });
  return found == kUnits.end() ? nullptr : &*found;
}

int dxf_unit(const std::string& unit) {
  const auto found = std::find_if(kUnits.begin(), kUnits.end(),
                                  [&unit](const DxfUnit& known) { return unit == known.name; });
  return found == kUnits.end() ? 0 : found->code;
}

}  // namespace keyline::exchange::detail
