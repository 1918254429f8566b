#include <algorithm>

#include "keyline/core/text.h"
#include "keyline/surface/conditions.h"

namespace keyline::surface {
namespace {

/// "1.1..1.4"; a single number as both ends.
std::optional<core::Interval> range_from_text(std::string_view text) {
  const std::size_t dots = text.find("..");
  const auto low = core::parse_number(text.substr(0, dots));
  const auto high =
      dots == std::string_view::npos ? low : core::parse_number(text.substr(dots + 2));
  if (!low || !high || !(*low <= *high)) return std::nullopt;
  return core::Interval{*low, *high};
}

/// One "name=value" put into the condition; false where it is none.
bool put(std::string_view name, std::string_view value, CurveCondition& condition) {
  if (name == "branch") {
    for (const auto& word : choices(static_cast<const classa::Branch*>(nullptr)))
      if (word.word == value) condition.branch = word.value;
    return condition.branch.has_value();
  }
  if (name == "tangent") {
    condition.tangent = value == "kept";
    return value == "kept" || value == "free";
  }
  const auto range = range_from_text(value);
  if (!range) return false;
  if (name == "end") condition.end_tolerance = range->low;
  if (name == "alpha") condition.alpha = range;
  if (name == "s") condition.s = range;
  return name == "end" || name == "alpha" || name == "s";
}

}  // namespace

core::Result<CurveCondition> CurveCondition::from_text(std::string_view text) {
  CurveCondition condition;
  std::size_t at = 0;
  if (const std::size_t colon = text.find(':'); colon != std::string_view::npos) {
    condition.curve = text.substr(0, colon);
    at = colon + 1;
  }
  while (at <= text.size()) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string_view part = text.substr(at, end - at);
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos ||
        !put(part.substr(0, equals), part.substr(equals + 1), condition))
      return core::fail(
          core::ErrorCode::bad_input,
          "\"" + std::string(part) + "\" of \"" + std::string(text) + "\" is no condition",
          "write " + std::string(kTextForm));
    at = end + 1;
  }
  return condition;
}

}  // namespace keyline::surface
