#pragma once

#include <string_view>

namespace keyline::exchange {

/// True for well-formed UTF-8 (no overlong forms, no surrogates).
bool is_utf8(std::string_view bytes);

}  // namespace keyline::exchange
