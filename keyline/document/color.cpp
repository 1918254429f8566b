#include "keyline/document/color.h"

#include <charconv>

namespace keyline::document {

int color_value(const std::string& text) {
  int value = 0;
  if (text.size() != 7 || text[0] != '#') return -1;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, value, 16);
  return error == std::errc() && end == text.data() + 7 && value >= 0 ? value : -1;
}

}  // namespace keyline::document
