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

/// What a field within quotes holds, doubled quotes made single.
std::string unquoted(std::string_view field);

/// Fields of a line, trimmed; empty ones after the last separator are dropped. Separators within
/// quotes separate nothing, except spaces. Where white space separates, two numbers that touch as
/// in Fortran's fixed columns ("0.9968-0.0004") are two.
std::vector<std::string_view> split(std::string_view line, TableStyle style);

/// Fields of the line, empty ones after the last separator counted too.
std::size_t count_cells(std::string_view line, TableStyle style);

/// A number written with point or comma, maybe in brackets; "nan", "inf", "null", "na", "n/a", the
/// errors of spreadsheets ("#N/A", "#DIV/0!") and the empty field give NaN or infinity. Empty where
/// the field is something else.
std::optional<double> parse_number(std::string_view field, TableStyle style);

/// The style in which the most fields of the line are numbers.
TableStyle guess_style(std::string_view line);

/// Lower case, without quotes, comment marks, and a unit in brackets or after a slash or
/// underscore.
std::string plain_name(std::string_view field);

/// True for a line that is a comment, and no row that begins with a spreadsheet's error.
bool is_comment(std::string_view line);

/// The text of a comment line after its mark.
std::string_view comment_text(std::string_view line);

}  // namespace keyline::exchange::detail
