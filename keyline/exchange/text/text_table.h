#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace keyline::exchange::detail {

/// How the fields of a line are told apart.
struct TableStyle {
  char separator = ' ';  ///< ',', ';', '|', '\t', or ' ' for any white space
  bool decimal_comma = false;
};

std::string_view trimmed(std::string_view text);

/// What a field within quotes holds, doubled quotes made single.
std::string unquoted(std::string_view field);

/// Fields of a line, trimmed; empty ones after the last separator are dropped. Separators within
/// quotes separate nothing, except spaces.
std::vector<std::string_view> split(std::string_view line, TableStyle style);

/// A number written with point or comma, maybe in brackets; "nan", "inf", "null", "na", "n/a" and
/// the empty field give NaN or infinity. Empty where the field is something else.
std::optional<double> parse_number(std::string_view field, TableStyle style);

/// The style in which the most fields of the line are numbers.
TableStyle guess_style(std::string_view line);

/// Lower case, without quotes, comment marks, and a unit in brackets or after an underscore.
std::string plain_name(std::string_view field);

/// That unit, lower case; empty where there is none.
std::string unit_of_name(std::string_view field);

/// True for a line that is a comment.
bool is_comment(std::string_view line);

/// The text of a comment line after its mark.
std::string_view comment_text(std::string_view line);

}  // namespace keyline::exchange::detail
