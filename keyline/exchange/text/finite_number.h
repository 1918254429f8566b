#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace keyline::exchange::detail {

/// The finite number a text is, from its first character to its last (a + may stand before it);
/// what is too small for a double is 0, what is too large, "nan" and "inf" are none. Whatever the
/// locale.
inline std::optional<double> finite_number(std::string_view text) {
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

}  // namespace keyline::exchange::detail
