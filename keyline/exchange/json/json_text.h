#pragma once

#include <string_view>

#include <nlohmann/json.hpp>

#include "keyline/core/error.h"

namespace keyline::exchange {

inline constexpr int kDeepestJson = 200;

/// The value a JSON text stands for.
///
/// Fails: bad_input with "line N" for what is not JSON, for values nested deeper than kDeepestJson
///        (everything that walks the value may therefore recurse), numbers beyond doubles, and two
///        members of one name in an object: readers differ in which they take (RFC 8259, 4).
core::Result<nlohmann::json> parse_json(std::string_view text);

}  // namespace keyline::exchange
