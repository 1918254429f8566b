#include "keyline/exchange/json/json_text.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "keyline/exchange/text/ascii.h"

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

std::string line_at(std::string_view text, std::size_t byte) {
  return "line " + std::to_string(detail::line_of(text, static_cast<std::ptrdiff_t>(byte)));
}

/// A name a second time, and where it stands.
struct Repeated {
  std::string name;
  std::size_t at = 0;
};

/// Goes through sound JSON for the first object that holds a name twice.
class Names {
 public:
  explicit Names(std::string_view text) : text_(text) {}

  std::optional<Repeated> repeated() {
    for (std::size_t i = 0; i < text_.size(); ++i) {
      if (text_[i] == '"') {
        const std::size_t from = std::exchange(i, closing_quote(i));
        if (!is_name(i)) continue;
        std::string name = text_of(text_.substr(from, i + 1 - from));
        if (!objects_.back().insert(name).second) return Repeated{std::move(name), from};
      } else if (text_[i] == '{') {
        objects_.emplace_back();
      } else if (text_[i] == '}') {
        objects_.pop_back();
      }
    }
    return std::nullopt;
  }

 private:
  std::size_t closing_quote(std::size_t i) const {
    for (++i; text_[i] != '"'; ++i)
      if (text_[i] == '\\') ++i;
    return i;
  }

  /// Whether what ends with this quote is a member's name.
  bool is_name(std::size_t quote) const {
    const std::size_t next = text_.find_first_not_of(" \t\r\n", quote + 1);
    return next != std::string_view::npos && text_[next] == ':';
  }

  /// Without quotes and escapes, which name no other member.
  static std::string text_of(std::string_view name) {
    if (name.find('\\') != std::string_view::npos) return json::parse(name).get<std::string>();
    return std::string(name.substr(1, name.size() - 2));
  }

  std::string_view text_;
  std::vector<std::set<std::string>> objects_;  ///< names of those that are open
};

}  // namespace

core::Result<json> parse_json(std::string_view text) {
  using core::ErrorCode;
  if (const std::size_t at = too_deep(text); at < text.size())
    return core::fail(ErrorCode::bad_input,
                      "values are nested deeper than " + std::to_string(kDeepestJson),
                      "flatten them around byte " + std::to_string(at + 1), line_at(text, at));
  try {
    json value = json::parse(text);
    if (const auto twice = Names(text).repeated())
      return core::fail(ErrorCode::bad_input,
                        "an object has two members of the name " + json(twice->name).dump(),
                        "leave one of them", line_at(text, twice->at));
    return value;
  } catch (const json::parse_error& e) {
    return core::fail(ErrorCode::bad_input, "this is not JSON",
                      "mend it around byte " + std::to_string(e.byte), line_at(text, e.byte));
  } catch (const json::exception&) {
    return core::fail(ErrorCode::bad_input, "a number is too large for a double", "mend it");
  }
}

}  // namespace keyline::exchange
