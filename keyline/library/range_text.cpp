#include <charconv>
#include <cmath>
#include <optional>

#include "keyline/library/search.h"

namespace keyline::library {
namespace {

std::optional<double> number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<Range> around(std::string_view text) {
  for (const std::string_view sign : {"±", "+-"}) {
    const std::size_t at = text.find(sign);
    if (at == std::string_view::npos) continue;
    const auto middle = number(text.substr(0, at));
    const auto half = number(text.substr(at + sign.size()));
    if (middle && half && *half >= 0) return Range{*middle - *half, *middle + *half};
  }
  return std::nullopt;
}

std::optional<Range> between(std::string_view text) {
  const std::size_t at = text.find("..");
  if (at == std::string_view::npos) return std::nullopt;
  const auto low = number(text.substr(0, at));
  const auto high = number(text.substr(at + 2));
  if (low && high && *low <= *high) return Range{*low, *high};
  return std::nullopt;
}

std::optional<Range> one_sided(std::string_view text) {
  const bool below = text.starts_with('<');
  if (!below && !text.starts_with('>')) return std::nullopt;
  const bool closed = text.substr(1).starts_with('=');
  const auto end = number(text.substr(closed ? 2 : 1));
  if (!end) return std::nullopt;
  // The next double: "<1" leaves 1 itself out.
  const double last = closed ? *end : std::nextafter(*end, below ? -HUGE_VAL : HUGE_VAL);
  return below ? Range{{}, last} : Range{last, {}};
}

}  // namespace

core::Result<Range> Range::from_text(std::string_view text) {
  if (const auto range = one_sided(text)) return *range;
  if (const auto range = around(text)) return *range;
  if (const auto range = between(text)) return *range;
  if (const auto value = number(text)) return Range{*value, *value};
  return core::fail(core::ErrorCode::bad_input, "\"" + std::string(text) + "\" is no range",
                    "give " + std::string(kTextForm));
}

}  // namespace keyline::library
