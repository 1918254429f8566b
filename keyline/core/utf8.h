#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace keyline::core {

/// True for well-formed UTF-8 (no overlong forms, no surrogates).
bool is_utf8(std::string_view bytes);

/// Code point at `at`, which moves behind it; U+FFFD for bytes that are no UTF-8.
unsigned code_point(std::string_view text, std::size_t& at);

/// At most so many bytes of a text, no character of it cut through.
std::string_view whole_characters(std::string_view text, std::size_t most);

/// Of Windows-1252, which agrees with ISO 8859-1 but for control characters.
std::string from_windows_1252(std::string_view bytes);

/// Appends a code point up to U+10FFFF; surrogates and what lies beyond as U+FFFD.
void append_utf8(std::string& text, unsigned code);

}  // namespace keyline::core
