#include "keyline/core/text.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace keyline::core {

std::string number_text(double value, int significant_digits) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::general, std::clamp(significant_digits, 1, 17));
  return {text.data(), end.ptr};
}

}  // namespace keyline::core
