#include "keyline/fairing/symmetric.h"

#include <cmath>
#include <optional>
#include <string>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"

namespace keyline::fairing {
namespace {

/// x=3 or y=3.
std::optional<Symmetric> upright_or_level(std::string_view text) {
  const auto value = core::parse_number(text.substr(2));
  if (!value || (text[0] != 'x' && text[0] != 'y')) return std::nullopt;
  if (text[0] == 'x') return Symmetric{SymmetricMode::line, {*value, 0}, core::kPi / 2};
  return Symmetric{SymmetricMode::line, {0, *value}, 0};
}

/// X,Y:DEGREES.
std::optional<Symmetric> through_point(std::string_view text) {
  const std::size_t comma = text.find(',');
  const std::size_t colon = text.find(':');
  if (comma == text.npos || colon == text.npos || comma > colon) return std::nullopt;
  const auto x = core::parse_number(text.substr(0, comma));
  const auto y = core::parse_number(text.substr(comma + 1, colon - comma - 1));
  const auto degrees = core::parse_number(text.substr(colon + 1));
  if (!x || !y || !degrees) return std::nullopt;
  return Symmetric{SymmetricMode::line, {*x, *y}, *degrees * core::kPi / 180};
}

}  // namespace

core::Result<Symmetric> Symmetric::from_text(std::string_view text) {
  for (const auto& word : choices(static_cast<const SymmetricMode*>(nullptr)))
    if (word.word == text && word.value != SymmetricMode::line)
      return Symmetric{.mode = word.value, .point = {}};
  const bool axis = text.size() > 2 && text[1] == '=';
  if (const auto line = axis ? upright_or_level(text) : through_point(text)) return *line;
  return core::fail(core::ErrorCode::bad_input,
                    "\"" + std::string(text) + "\" is no line of symmetry",
                    "give " + std::string(kTextForm));
}

}  // namespace keyline::fairing
