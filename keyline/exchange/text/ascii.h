#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// Letters, blanks and lines of text, whatever the locale.
namespace keyline::exchange::detail {

/// With the letters A to Z small.
std::string lower_case(std::string_view text);

/// Blanks at the ends of a line of a table and of its fields; ^Z, the end mark of CP/M and DOS, is
/// one. Within a field it is none: it parts no number in two.
inline constexpr std::string_view kBlanks = " \t\f\v\x1a";

/// Without these at both ends.
std::string_view trimmed(std::string_view text, std::string_view blanks = kBlanks);

/// Without these in front: tabs at its end part empty cells of a row.
std::string_view trimmed_in_front(std::string_view text);

/// Number of the line, from 1, in which the byte at `offset` stands: 1 for what lies before the
/// text, the last for what lies behind it.
std::size_t line_of(std::string_view text, std::ptrdiff_t offset);

}  // namespace keyline::exchange::detail
