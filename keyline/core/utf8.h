#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace keyline::core {

/// True for well-formed UTF-8 (no overlong forms, no surrogates).
bool is_utf8(std::string_view bytes);

/// Code point at `at`, which moves behind it; U+FFFD for bytes that are no UTF-8.
unsigned code_point(std::string_view text, std::size_t& at);

/// Appends a code point up to U+10FFFF; surrogates and what lies beyond as U+FFFD.
void append_utf8(std::string& text, unsigned code);

}  // namespace keyline::core
