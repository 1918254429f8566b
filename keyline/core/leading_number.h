#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>

/// Numbers that a text starts with, for those who read on behind them; text.h has the rest.
namespace keyline::core {

/// A number at the start of a text, and how many characters it takes.
struct LeadingNumber {
  double value = 0;  ///< 0 where it is too small for a double, infinite where it is too large
  std::size_t length = 0;
};

/// The number a text starts with (a + may stand before it), whatever the locale; empty for anything
/// else, words for infinity and the like included.
std::optional<LeadingNumber> leading_number(std::string_view text);

/// The whole number a text starts with, taken off it; empty where there is none or it does not fit.
template <std::integral Whole>
std::optional<Whole> take_whole(std::string_view& text, int base = 10) {
  Whole value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// The whole number that the whole text stands for; empty for anything else.
template <std::integral Whole>
std::optional<Whole> parse_whole(std::string_view text, int base = 10) {
  const auto value = take_whole<Whole>(text, base);
  return text.empty() ? value : std::nullopt;
}

}  // namespace keyline::core
