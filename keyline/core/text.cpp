#include "keyline/core/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace keyline::core {

std::string number_text(double value, int significant_digits) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::general, std::clamp(significant_digits, 1, 17));
  return {text.data(), end.ptr};
}

std::optional<double> finite_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (end != last) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Only an exponent below zero, or none behind a long row of zeros, makes a number that small.
    const std::size_t mark = text.find_first_of("eE");
    const bool tiny = mark == std::string_view::npos ? text.find_first_of("123456789") > 300
                                                     : text.substr(mark + 1).starts_with('-');
    return tiny ? std::optional(0.0) : std::nullopt;
  }
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string counted(std::size_t n, std::string_view one, std::string_view many) {
  std::string text = std::to_string(n) + ' ';
  if (n == 1) return text.append(one);
  return many.empty() ? text.append(one) + 's' : text.append(many);
}

std::string on_one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return line;
}

}  // namespace keyline::core
