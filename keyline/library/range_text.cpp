#include <cmath>
#include <optional>

#include "keyline/core/text.h"
#include "keyline/library/search.h"

namespace keyline::library {
namespace {

std::optional<Range> around(std::string_view text) {
  for (const std::string_view sign : {"±", "+-"}) {
    const std::size_t at = text.find(sign);
    if (at == std::string_view::npos) continue;
    const auto middle = core::parse_number(text.substr(0, at));
    const auto half = core::parse_number(text.substr(at + sign.size()));
    if (middle && half && *half >= 0) return Range{*middle - *half, *middle + *half};
  }
  return std::nullopt;
}

std::optional<Range> between(std::string_view text) {
  const std::size_t at = text.find("..");
  if (at == std::string_view::npos) return std::nullopt;
  const auto low = core::parse_number(text.substr(0, at));
  const auto high = core::parse_number(text.substr(at + 2));
  if (low && high && *low <= *high) return Range{*low, *high};
  return std::nullopt;
}

std::optional<Range> one_sided(std::string_view text) {
  const bool below = text.starts_with('<');
  if (!below && !text.starts_with('>')) return std::nullopt;
  const bool closed = text.substr(1).starts_with('=');
  const auto end = core::parse_number(text.substr(closed ? 2 : 1));
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
  if (const auto value = core::parse_number(text)) return Range{*value, *value};
  return core::fail(core::ErrorCode::bad_input, "\"" + std::string(text) + "\" is no range",
                    "give " + std::string(kTextForm));
}

}  // namespace keyline::library
