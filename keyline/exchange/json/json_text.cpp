#include "keyline/exchange/json/json_text.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace keyline::exchange {
namespace {

using nlohmann::json;

/// Where values are first nested deeper than kDeepestJson; text.size() where they are nowhere.
std::size_t too_deep(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == '[' || c == '{') && ++depth > kDeepestJson)
      return i;
    else if (!quoted && (c == ']' || c == '}'))
      --depth;
  }
  return text.size();
}

std::string line_of(std::string_view text, std::size_t byte) {
  const auto upto = static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return "line " + std::to_string(1 + std::count(text.begin(), text.begin() + upto, '\n'));
}

}  // namespace

core::Result<json> parse_json(std::string_view text) {
  using core::ErrorCode;
  if (const std::size_t at = too_deep(text); at < text.size())
    return core::fail(ErrorCode::bad_input,
                      "values are nested deeper than " + std::to_string(kDeepestJson),
                      "flatten them around byte " + std::to_string(at + 1), line_of(text, at));
  try {
    return json::parse(text);
  } catch (const json::parse_error& e) {
    return core::fail(ErrorCode::bad_input, "this is not JSON",
                      "mend it around byte " + std::to_string(e.byte), line_of(text, e.byte));
  } catch (const json::exception&) {
    return core::fail(ErrorCode::bad_input, "a number is too large for a double", "mend it");
  }
}

}  // namespace keyline::exchange
