#include "keyline/core/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "keyline/core/leading_number.h"

namespace keyline::core {
std::string number_text(double value, int significant_digits) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::general, std::clamp(significant_digits, 1, 17));
  return {text.data(), end.ptr};
}

std::optional<double> parse_number(std::string_view text) {
  const auto number = leading_number(text);
  if (!number || number->length != text.size() || !std::isfinite(number->value))
    return std::nullopt;
  return number->value;
}

std::string counted(std::size_t n, std::string_view one, std::string_view many) {
  std::string text = std::to_string(n) + ' ';
  if (n == 1) return text.append(one);
  return many.empty() ? text.append(one) + 's' : text.append(many);
}

std::vector<std::string> told_in_part(std::vector<std::string> lines, std::string_view one,
                                      std::string_view many) {
  constexpr std::size_t kMost = 5;
  if (lines.size() <= kMost) return lines;
  const std::size_t more = lines.size() - kMost;
  lines.resize(kMost);
  lines.push_back(counted(more, one, many));
  return lines;
}

std::string on_one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return line;
}

}  // namespace keyline::core
