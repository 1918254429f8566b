#include "keyline/core/leading_number.h"

#include <algorithm>
#include <cmath>

namespace keyline::core {
namespace {

/// Whether the digits of a number that no double can hold stand for one of size below 1.
bool is_below_one(std::string_view digits) {
  const std::size_t mark = std::min(digits.find_first_of("eE"), digits.size());
  const std::string_view mantissa = digits.substr(0, mark);
  const auto point = static_cast<long>(std::min(mantissa.find('.'), mantissa.size()));
  const auto first = static_cast<long>(mantissa.find_first_of("123456789"));
  std::string_view exponent = digits.substr(std::min(mark + 1, digits.size()));
  const bool negative = exponent.starts_with('-');
  if (exponent.starts_with('+')) exponent.remove_prefix(1);
  constexpr long kBeyond = 1'000'000'000;  // of an exponent too long to read
  const long power = mark == digits.size()
                         ? 0
                         : parse_whole<int>(exponent).value_or(negative ? -kBeyond : kBeyond);
  return point - first + power <= 0;
}

}  // namespace

std::optional<LeadingNumber> leading_number(std::string_view text) {
  const std::size_t sign = text.starts_with('+') && !text.starts_with("+-") ? 1 : 0;
  LeadingNumber number;
  const char* const from = text.data() + sign;
  const auto [end, error] = std::from_chars(from, text.data() + text.size(), number.value);
  number.length = static_cast<std::size_t>(end - text.data());
  if (error == std::errc::result_out_of_range)
    number.value = is_below_one({from, static_cast<std::size_t>(end - from)}) ? 0 : HUGE_VAL;
  else if (error != std::errc() || !std::isfinite(number.value))
    return std::nullopt;
  return number;
}

}  // namespace keyline::core
