#include <algorithm>
#include <cmath>

#include "keyline/core/text.h"
#include "keyline/fairing/fair.h"

namespace keyline::fairing {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;

std::optional<Clamp> clamp_named(std::string_view text) {
  for (const auto& word : choices(static_cast<const Clamp*>(nullptr)))
    if (word.word == text) return word.value;
  return std::nullopt;
}

}  // namespace

Result<EndClamps> EndClamps::from_text(std::string_view text) {
  EndClamps clamps;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    const std::string_view part = text.substr(from, to - from);
    const std::size_t colon = std::min(part.find(':'), part.size());
    const std::string_view end = part.substr(0, colon);
    const auto clamp = clamp_named(part.substr(std::min(colon + 1, part.size())));
    if (!clamp || (end != "start" && end != "end"))
      return fail(ErrorCode::bad_input, "\"" + std::string(part) + "\" is no clamp",
                  "give start:G0, start:G1, start:G2, end:G0, end:G1 or end:G2");
    (end == "start" ? clamps.start : clamps.end) = *clamp;
    from = to + 1;
  }
  return clamps;
}

Result<InterpretationOverride> InterpretationOverride::from_text(std::string_view text) {
  const auto wrong = [&] {
    return fail(ErrorCode::bad_input, "\"" + std::string(text) + "\" is no reading of a piece",
                "give " + std::string(kTextForm));
  };
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return wrong();
  const auto piece = core::parse_number(text.substr(0, colon));
  if (!piece || *piece != std::floor(*piece) || *piece < 0 || *piece > 1e6) return wrong();
  InterpretationOverride asked;
  asked.piece = static_cast<int>(*piece);
  const std::string_view what = text.substr(colon + 1);
  if (what.starts_with("slope="))
    asked.slope = core::parse_number(what.substr(6));
  else
    asked.rhythm = analysis::parse_rhythm(what);
  if (!asked.slope && !asked.rhythm) return wrong();
  return asked;
}

Result<void> InterpretationOverride::check(const InterpretationOverride& asked) {
  if (asked.rhythm.has_value() != asked.slope.has_value()) return {};
  return fail(ErrorCode::bad_input, "a reading is a rhythm or a slope",
              "give either \"rhythm\" or \"slope\"", asked.slope ? "slope" : "rhythm");
}

}  // namespace keyline::fairing
