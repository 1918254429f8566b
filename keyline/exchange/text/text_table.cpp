#include "keyline/exchange/text/text_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "keyline/core/leading_number.h"
#include "keyline/core/text.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/header_unit.h"

namespace keyline::exchange::detail {
namespace {

/// What spreadsheets show where a cell has no value: "#N/A", "#DIV/0!", "#VALUE!", "#NAME?"
/// (ECMA-376 part 1, 18.17.3), or that in other languages ("#NV", "#N/D", "#WERT!").
bool is_error_value(std::string_view field) {
  if (field.size() < 3 || field[0] != '#') return false;
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  if (field.size() == 4 && field[2] == '/' && is_capital(field[1]) && is_capital(field[3]))
    return true;
  if (field == "#NV") return true;
  const auto is_other = [](char c) { return (c >= 'a' && c <= 'z') || c == ' ' || c == '#'; };
  return (field.ends_with('!') || field.ends_with('?')) &&
         std::none_of(field.begin() + 1, field.end(), is_other);
}

/// Whether a row begins with such a value: fields are behind it, or numbers.
bool begins_with_error_value(std::string_view line) {
  const std::size_t end = std::min(line.find_first_of(",;| \t"), line.size());
  if (!is_error_value(line.substr(0, end))) return false;
  line.remove_prefix(end);
  const std::size_t next = line.find_first_not_of(" \t");
  return next != line.npos && std::string_view(",;|#+-.0123456789").find(line[next]) != line.npos;
}

std::optional<double> missing_value(std::string_view field) {
  if (is_error_value(field)) return std::numeric_limits<double>::quiet_NaN();
  if (field.size() > 9) return std::nullopt;
  std::string name = lower_case(field);
  const bool negative = name.starts_with('-');
  if (negative || name.starts_with('+')) {
    name.erase(0, 1);
    if (name.empty()) return std::nullopt;
  }
  const double infinity = std::numeric_limits<double>::infinity();
  if (name == "inf" || name == "infinity") return negative ? -infinity : infinity;
  for (const std::string_view known : {"", "nan", "null", "na", "n/a", "none"}) {
    if (name == known) return std::numeric_limits<double>::quiet_NaN();
  }
  return std::nullopt;
}

/// Where a field in quotes ends, doubled quotes within let pass; 0 for a field without quotes.
std::size_t end_of_quoted(std::string_view line) {
  if (!line.starts_with('"')) return 0;
  for (std::size_t at = line.find('"', 1); at != std::string_view::npos;
       at = line.find('"', at + 2))
    if (at + 1 == line.size() || line[at + 1] != '"') return at + 1;
  return 0;
}

std::size_t count_numbers(std::string_view line, TableStyle style) {
  const auto fields = split(line, style);
  return static_cast<std::size_t>(std::count_if(fields.begin(), fields.end(), [&](auto field) {
    return !field.empty() && parse_number(field, style).has_value();
  }));
}

/// The first field of a line, trimmed, and what is behind its separator; without one nothing is.
std::string_view take_field(std::optional<std::string_view>& rest, char separator) {
  std::string_view line = *rest;
  line = line.substr(std::min(line.find_first_not_of(' '), line.size()));
  const std::size_t stop = line.find(separator, end_of_quoted(line));
  rest = stop == line.npos ? std::nullopt : std::optional(line.substr(stop + 1));
  return trimmed(line.substr(0, stop));
}

/// Two numbers of Fortran's fixed columns that touch ("0.9968-0.0004"): the length of the first;
/// 0 where it is anything else.
std::size_t end_of_touching(std::string_view field) {
  const auto first = core::leading_number(field);
  if (!first || first->length >= field.size()) return 0;
  const std::string_view head = field.substr(0, first->length);
  const std::string_view rest = field.substr(first->length);
  const auto second = core::leading_number(rest);
  const bool fractions = head.find('.') != head.npos && rest.find('.') != rest.npos;
  return fractions && second && (rest[0] == '-' || rest[0] == '+') ? first->length : 0;
}

}  // namespace

std::string unquoted(std::string_view field) {
  std::string text;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    text += field[i];
    if (field[i] == '"' && field[i + 1] == '"') ++i;
  }
  return text;
}

std::vector<std::string_view> split(std::string_view line, TableStyle style) {
  std::vector<std::string_view> fields;
  line = trimmed(line);
  if (style.separator == ' ') {
    while (!line.empty()) {
      std::size_t length = std::min(line.find_first_of(" \t\f\v"), line.size());
      if (const std::size_t touching = end_of_touching(line.substr(0, length)); touching > 0)
        length = touching;
      fields.push_back(line.substr(0, length));
      line = trimmed(line.substr(length));
    }
    return fields;
  }
  for (std::optional rest = line; rest;) fields.push_back(take_field(rest, style.separator));
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

std::size_t count_cells(std::string_view line, TableStyle style) {
  if (style.separator == ' ') return split(line, style).size();
  std::size_t cells = 0;
  for (std::optional rest = line; rest; ++cells) take_field(rest, style.separator);
  return cells;
}

std::optional<double> parse_number(std::string_view field, TableStyle style) {
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
    field = trimmed(field.substr(1, field.size() - 2));
  }
  // Points written as (x, y), [x, y] or {x, y}.
  const auto is_one_of = [](char c, std::string_view marks) { return marks.find(c) != marks.npos; };
  while (!field.empty() && is_one_of(field.front(), "([{")) field = trimmed(field.substr(1));
  while (!field.empty() && is_one_of(field.back(), ")]}"))
    field = trimmed(field.substr(0, field.size() - 1));
  std::array<char, 128> text;
  if (field.size() > text.size()) return std::nullopt;
  std::copy(field.begin(), field.end(), text.begin());
  for (char& c : std::span(text).first(field.size())) {
    // Fortran writes exponents with D.
    if (c == 'D' || c == 'd') c = 'e';
    if (style.decimal_comma && c == ',') c = '.';
  }
  const auto number = core::leading_number({text.data(), field.size()});
  if (!number || number->length != field.size()) return missing_value(field);
  // Above the largest double: too large for anybody, but no infinity that somebody wrote.
  return std::isinf(number->value) ? std::numeric_limits<double>::max() : number->value;
}

TableStyle guess_style(std::string_view line) {
  constexpr std::array<TableStyle, 7> styles{{{';', true},
                                              {';', false},
                                              {'|', false},
                                              {'\t', true},
                                              {',', false},
                                              {' ', true},
                                              {' ', false}}};
  TableStyle best{' ', false};
  std::size_t most = 0;
  for (const TableStyle style : styles) {
    if (style.separator != ' ' && line.find(style.separator) == std::string_view::npos) continue;
    if (style.decimal_comma && line.find(',') == std::string_view::npos) continue;
    const std::size_t numbers = count_numbers(line, style);
    const bool clean = style.separator != ',' || line.find(", ") != std::string_view::npos ||
                       line.find(" ,") != std::string_view::npos ||
                       count_numbers(line, {' ', true}) < 2;
    if (numbers > most && clean) {
      most = numbers;
      best = style;
    }
  }
  return best;
}

std::string plain_name(std::string_view field) {
  std::string name = lower_case(trimmed(field));
  std::erase(name, '"');
  std::erase(name, '\'');
  if (const std::size_t unit = start_of_unit(name); unit != std::string::npos) name.erase(unit);
  return std::string(trimmed(name));
}

bool is_comment(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with('#')) return !begins_with_error_value(line);
  return line.starts_with('%') || line.starts_with('!') || line.starts_with("//");
}

std::string_view comment_text(std::string_view line) {
  line = trimmed(line);
  while (!line.empty() && (line[0] == '#' || line[0] == '%' || line[0] == '!' || line[0] == '/')) {
    line.remove_prefix(1);
  }
  return trimmed(line);
}

}  // namespace keyline::exchange::detail
