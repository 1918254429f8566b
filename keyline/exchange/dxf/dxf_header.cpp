#include "keyline/exchange/dxf/dxf_header.h"

#include "keyline/exchange/dxf/dxf_entity.h"
#include "keyline/exchange/dxf/dxf_units.h"

namespace keyline::exchange::detail {

std::string DxfHeader::take(const DxfTag& tag, const std::string& place) {
  if (tag.code == 9) variable_ = std::string(tag.text);
  if (variable_ == "$DWGCODEPAGE" && tag.code == 3) code_page_ = std::string(tag.text);
  if (variable_ != "$INSUNITS" || tag.code != 70) return {};
  const auto given = integer_of(tag);
  if (!given) return "the unit of the drawing: it is no number (" + place + ")";
  const DxfUnit* unit = dxf_unit_of(*given);
  const bool other = given_ && given_ != given;
  given_ = given;
  unit_ = unit ? unit->name : "";
  scale_ = unit ? unit->factor : 1;
  if (!unit) return "the unit of the drawing ($INSUNITS " + std::to_string(*given) + ")";
  if (other) return "an earlier unit of the drawing: $INSUNITS has another value at " + place;
  return {};
}

}  // namespace keyline::exchange::detail
