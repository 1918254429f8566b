#include "keyline/operations/common_unit.h"

#include "keyline/core/text.h"
#include "keyline/document/document.h"

namespace keyline::operations {
namespace {

std::string advice(const std::string& unit, const std::string& others) {
  const double from = document::millimetres(unit);
  const double to = document::millimetres(others);
  if (!(from > 0 && to > 0)) return "give files in one unit";
  return "bring it to " + others + " first: keyline transform --scale " +
         core::number_text(from / to, 10) + " --unit " + others;
}

}  // namespace

core::Result<void> CommonUnit::take(const std::string& unit, const std::string& file) {
  if (unit.empty() || unit == name_) return {};
  if (!name_.empty())
    return core::fail(core::ErrorCode::bad_input,
                      "is in " + unit + ", " + told_by_ + " in " + name_, advice(unit, name_),
                      file);
  name_ = unit;
  told_by_ = file;
  return {};
}

}  // namespace keyline::operations
