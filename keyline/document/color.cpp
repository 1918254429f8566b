#include "keyline/document/color.h"

#include <string_view>

#include "keyline/core/leading_number.h"

namespace keyline::document {

int color_value(const std::string& text) {
  if (text.size() != 7 || text[0] != '#') return -1;
  const auto value = core::parse_whole<unsigned>(std::string_view(text).substr(1), 16);
  return value ? static_cast<int>(*value) : -1;
}

}  // namespace keyline::document
