#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace keyline::core {

/// value with so many significant digits (1 to 17), for messages: the shorter of plain and
/// scientific notation, no trailing zeros ("0.25", "1.5e-09", "nan", "inf"), whatever the locale.
std::string number_text(double value, int significant_digits);

/// The finite number the whole text stands for, whatever the locale; empty for anything else.
std::optional<double> parse_number(std::string_view text);

/// So many of a thing, for messages: "1 piece", "2 pieces"; `many` where "s" is not the plural.
std::string counted(std::size_t n, std::string_view one, std::string_view many = {});

/// The first five of what is told line by line; the rest counted in one line more.
std::vector<std::string> told_in_part(std::vector<std::string> lines, std::string_view one,
                                      std::string_view many = {});

/// The text with a space in place of every ASCII control character, so that it stays on its line.
std::string on_one_line(std::string_view text);

}  // namespace keyline::core
