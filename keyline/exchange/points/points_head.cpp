#include "keyline/exchange/points/points_head.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/exchange/points/points_nodes.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange::detail {
namespace {

using core::ErrorCode;
using Fields = std::vector<std::string_view>;

/// The first of them is the title, but for a zone's.
void remember_title(PointsHead& head, std::string_view line, int number) {
  constexpr std::size_t kMostKept = 100;
  const std::string said = tecplot_title(line);
  const bool first = head.titles.empty() || (is_tecplot_zone(line) && !said.empty());
  if (head.titles.size() < kMostKept)
    head.titles.insert(first ? head.titles.begin() : head.titles.end(),
                       "line " + std::to_string(number) + ": " + shortened(line));
  if (first) head.first_text = shortened(said.empty() ? line : said);
  head.last_text = is_tecplot_zone(line) ? "" : std::string(line.substr(0, 4096));
  ++head.text_lines;
}

/// Tabs part fields where a header's do so, or where the first is a name; elsewhere they are white
/// space as any other, of which there may be several in a row.
bool tabs_part(const PointsHead& head, std::string_view line) {
  const Fields fields = split(line, {'\t', head.style.decimal_comma});
  if (fields.size() < 2) return false;
  if (!head.names.empty()) return head.separator == '\t' && fields.size() <= head.names.size();
  return fields.size() >= 3 && !parse_number(fields[0], head.style) &&
         all_numbers(fields, head.style, 1);
}

/// Whether commas with a blank behind part the line into pairs of whole numbers: "0,5, 1,5".
bool has_pairs(std::string_view line) {
  std::size_t pairs = 0;
  for (std::size_t end = 0; end != line.npos; ++pairs) {
    end = line.find(", ");
    const Fields pair = split(line.substr(0, end), {',', false});
    const auto whole = [](std::string_view f) {
      return !f.empty() && f.find_first_not_of("0123456789") == f.npos;
    };
    if (pair.size() != 2 || !whole(pair[1])) return false;
    const bool sign = pair[0].starts_with('-') || pair[0].starts_with('+');
    if (!whole(pair[0].substr(sign ? 1 : 0))) return false;
    if (end != line.npos) line.remove_prefix(end + 1);
  }
  return pairs > 1;
}

/// Whether the header's separator parts the row into its columns. Names of curves in it may hold
/// others, and more numbers than there are coordinates.
bool header_parts(const PointsHead& head, const PointsOptions& options, std::string_view line) {
  if (head.separator == ' ' || !names_curves(head.names, options)) return false;
  const TableStyle style{head.separator, head.separator != ',' && line.find(',') != line.npos};
  const Fields fields = split(line, style);
  const auto texts =
      std::ranges::count_if(fields, [&](std::string_view f) { return !parse_number(f, style); });
  return fields.size() >= 3 && fields.size() <= head.names.size() && texts <= 1;
}

void take_style(PointsHead& head, const PointsOptions& options, std::string_view line) {
  const char separator = options.separator == 0 && header_parts(head, options, line)
                             ? head.separator
                             : options.separator;
  TableStyle& style = head.style;
  style = separator == 0 ? guess_style(line)
                         : TableStyle{separator, separator != ',' && line.find(',') != line.npos};
  if (separator == 0 && style.separator == ' ' && tabs_part(head, line)) style.separator = '\t';
  head.pairs = style.separator == ',' && has_pairs(line);
  head.fraction_known =
      style.separator == ',' || style.separator == ' ' || line.find_first_of(".,") != line.npos;
}

/// A header may be separated by a comma although rows are not, and the other way round.
bool take_header(PointsHead& head, const PointsOptions& options, std::string_view text, int number,
                 bool comment) {
  for (const char separator : {',', ';', '\t', ' '}) {
    std::vector<std::string> names;
    std::vector<HeaderUnit> units;
    const Fields cells = split(text, {separator, false});
    for (const auto field : cells) {
      names.push_back(plain_name(field));
      units.push_back(unit_of(field));
    }
    auto sides = find_sides(cells, separator == ' ');
    if (!sides && !is_points_header(names, options)) continue;
    head.sides = std::move(sides);
    head.names = std::move(names);
    head.units = std::move(units);
    head.separator = separator;
    head.counts = comment;
    head.line = number;
    return true;
  }
  return false;
}

/// What stands where a unit belongs, without its brackets; empty where it says that there is none.
std::string unknown_unit(std::string_view cell) {
  std::string text(cell);
  std::erase_if(text, [](char c) { return std::string_view("[]()\"").contains(c); });
  const std::string_view unit = trimmed(text);
  return std::string(unit == "-" || unit == "1" ? std::string_view{} : unit);
}

/// A second line of a header, of units alone: "mm,mm", "[m];[m];-".
bool take_unit_row(PointsHead& head, std::string_view text, int number) {
  if (head.names.empty()) return false;
  const Fields fields = split(text, {head.separator, false});
  if (fields.size() < 2 || fields.size() > head.names.size()) return false;
  const auto is_number = [&](std::string_view field) {  // with either fraction
    return !field.empty() && (parse_number(field, {head.separator, false}) ||
                              parse_number(field, {head.separator, true}));
  };
  if (std::ranges::any_of(fields, is_number)) return false;
  std::vector<HeaderUnit> units;
  for (const std::string_view field : fields) units.push_back(unit_alone(field));
  const auto is_known = [](const HeaderUnit& u) { return !u.known.empty(); };
  const auto says = [&](const HeaderUnit& u) {
    return is_known(u) || (!u.unknown.empty() && !u.round);
  };
  if (std::ranges::none_of(units, says)) return false;
  // beside a unit that is known other words are units, too, but in a sentence of them
  const bool all_are_units = std::ranges::any_of(units, is_known);
  const bool others = std::ranges::any_of(fields, [](std::string_view field) {
    return unit_alone(field).known.empty() && !unknown_unit(field).empty();
  });
  if (all_are_units && others && !unit_said(text).empty()) return false;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (all_are_units && !is_known(units[i])) units[i] = {{}, unknown_unit(fields[i]), false};
    if (says(units[i])) head.units[i] = units[i];
  }
  head.line = number;
  return true;
}

core::Failure two_units(const std::string& one, const std::string& other,
                        const std::string& place) {
  return {ErrorCode::bad_input,
          "the header gives the coordinates two units, " + one + " and " + shortened(other),
          "give all coordinates in one", place};
}

/// Whether a row below a header of so many names has two fields for each number and no fraction:
/// what decimal commas make of it.
bool has_decimal_commas(const Fields& fields, std::size_t named, const TableStyle& style) {
  const auto texts = static_cast<std::size_t>(
      std::ranges::count_if(fields, [&](auto f) { return !f.empty() && !parse_number(f, style); }));
  return style.separator == ',' && named >= 2 && fields.size() > named &&
         fields.size() + texts == 2 * named &&
         std::ranges::all_of(fields, [](auto f) { return f.find('.') == f.npos; });
}

/// "# x y" over rows that begin with 1: the mark of a comment is a column's name.
void name_the_mark(PointsHead& head) {
  head.names.insert(head.names.begin(), "#");
  head.units.insert(head.units.begin(), HeaderUnit{});
  if (!head.sides) return;
  for (Sides::Side* side : {&head.sides->first, &head.sides->second}) {
    ++side->x;
    ++side->y;
  }
}

/// Names in quotes with commas between; other text as it is.
std::string listed(std::string_view text) {
  std::string list;
  for (std::size_t at = text.find('"'); at != text.npos;) {
    const std::size_t end = std::min(text.find('"', at + 1), text.size() - 1);
    list.append(list.empty() ? "" : ", ").append(text.substr(at, end + 1 - at));
    at = text.find('"', end + 1);
  }
  return list.empty() ? std::string(text) : list;
}

/// Whether the line names variables of Tecplot, or further ones.
bool take_variables(PointsHead& head, const PointsOptions& options, std::string_view line,
                    int number) {
  const auto variables = tecplot_variables(line);
  if (!variables && (head.variables.empty() || !line.starts_with('"'))) return false;
  head.variables = variables ? listed(*variables) : head.variables + ", " + listed(line);
  take_header(head, options, head.variables, number, false);
  return true;
}

}  // namespace

core::Result<bool> is_first_row(PointsHead& head, const PointsOptions& options,
                                std::string_view line, int number, const std::string& place) {
  const bool comment = is_comment(line);
  if (take_variables(head, options, line, number)) return false;
  const std::string_view text = comment ? comment_text(line) : line;
  if (is_tecplot_zone(line)) {
    remember_title(head, line, number);
    return false;
  }
  if (take_unit_row(head, text, number) || lower_case(text).starts_with("sep=")) return false;
  if (!comment) {
    take_style(head, options, line);
    const TableStyle& style = head.style;
    const Fields fields = split(line, style);
    if (!head.names.empty() && head.names.size() <= fields.size() + 1 && fields.size() >= 2)
      return true;
    const auto first = fields.empty() ? std::nullopt : parse_number(fields[0], style);
    head.text_id =
        style.separator != ' ' && fields.size() >= 3 && all_numbers(fields, style, 1) && !first;
    if (fields.size() >= 2 && (head.text_id || all_numbers(fields, style, 0))) return true;
    if (style.separator != ' ' && fields.size() >= 2 && first && !std::isnan(*first)) {
      return core::fail(ErrorCode::bad_input,
                        "text where a number belongs: '" + shortened(line) + "'",
                        "give numbers only, or start the line with #", place);
    }
  }
  if (take_header(head, options, text, number, comment)) return false;
  if (const std::string unit = unit_said(text); !unit.empty()) {
    head.said_unit = unit;
    if (lower_case(text).starts_with("unit")) return false;  // it says nothing else
  }
  if (!comment) remember_title(head, line, number);
  return false;
}

core::Result<PointsColumns> columns_below(PointsHead& head, const PointsOptions& options,
                                          const Fields& first_row, const std::string& place) {
  const std::size_t width = first_row.size();
  if (head.counts && width == head.names.size() + 1 && first_row[0] == "1") name_the_mark(head);
  // Words between spaces are a title; a line with tabs heads columns, which tabs or spaces part.
  const bool tabs = head.last_text.find('\t') != std::string::npos;
  const TableStyle heads =
      tabs && head.style.separator == ' ' ? TableStyle{'\t', false} : head.style;
  head.headed =
      head.text_lines > 0 && heads.separator != ' ' ? split(head.last_text, heads).size() : 0;
  head.unknown = head.headed == width;
  const std::size_t named = head.names.empty() ? head.headed : head.names.size();
  const bool commas = has_decimal_commas(first_row, named, head.style);
  if (commas || (head.pairs && named != width))
    return core::fail(
        ErrorCode::bad_input,
        commas ? std::to_string(width) + " columns below a header of " + std::to_string(named)
               : "commas that part columns or fractions",
        "where numbers have a decimal comma, separate columns by ; or blanks", place);
  auto columns = choose_columns(head.names, options, width, head.text_id, place);
  if (columns && head.sides && options.columns.empty()) {
    columns->x = head.sides->first.x;
    columns->y = head.sides->first.y;
    columns->x2 = head.sides->second.x;
    columns->y2 = head.sides->second.y;
    columns->z = PointsColumns::kNone;
  }
  return columns;
}

void meet_fraction(PointsHead& head, std::string_view line) {
  const std::size_t at = head.fraction_known ? line.npos : line.find_first_of(".,");
  if (at == line.npos) return;
  head.fraction_known = true;
  head.style.decimal_comma = line[at] == ',';
}

std::size_t further_columns(const PointsHead& head, std::size_t width) {
  const std::size_t known = !head.names.empty() ? head.names.size() : head.text_id ? 4 : 3;
  return width - std::min(width, known);
}

std::vector<std::string> columns_beside(const PointsHead& head, const PointsColumns& columns,
                                        std::size_t further) {
  std::vector<std::string> lines;
  if (further > 0) lines.push_back(core::counted(further, "further column"));
  std::string others;
  for (std::size_t k = 0; k < head.names.size(); ++k) {
    if (columns.takes(static_cast<int>(k)) || head.names[k].empty()) continue;
    others += (others.empty() ? "" : ", ") + head.names[k];
  }
  if (!others.empty()) lines.push_back("columns beside: " + shortened(others));
  return lines;
}

core::Result<std::string> unit_below(const PointsHead& head, const PointsColumns& columns,
                                     const std::string& place, std::vector<std::string>& left_out) {
  std::string unit;
  std::string other;  // what can be nothing but a unit, and is none of documents
  std::vector<std::string> told;
  for (const int column : {columns.x, columns.y, columns.z, columns.x2, columns.y2}) {
    if (column < 0 || static_cast<std::size_t>(column) >= head.units.size()) continue;
    const auto& [known, unknown, round] = head.units[static_cast<std::size_t>(column)];
    const bool side = round && head.sides;  // every word of the cell has been understood
    if (!unknown.empty() && !side && std::ranges::find(told, unknown) == told.end()) {
      told.push_back(unknown);
      const std::string cell = round ? "(" + shortened(unknown) + ") behind the name of column " +
                                           std::to_string(column + 1)
                                     : "the unit " + shortened(unknown);
      left_out.push_back("line " + std::to_string(head.line) + ": " + cell +
                         ", which is none of mm, cm, m, km, in, ft, pt, px");
    }
    if (!round && other.empty()) other = unknown;
    if (!unit.empty() && !known.empty() && unit != known)
      return std::unexpected(two_units(unit, known, place));
    if (!known.empty()) unit = known;
  }
  if (!unit.empty() && !other.empty()) return std::unexpected(two_units(unit, other, place));
  return unit.empty() ? head.said_unit : unit;
}

std::vector<std::string> left_out_above(const PointsHead& head) {
  constexpr const char* kFirst = ": names no x and y: the first columns taken";
  std::vector<std::string> lines;
  if (!head.titles.empty()) lines.assign(head.titles.begin() + 1, head.titles.end());
  if (head.unknown && head.titles.size() > 1) lines.back() += kFirst;
  if (head.unknown && head.titles.size() == 1) lines.push_back(head.titles.front() + kFirst);
  if (head.names.empty() && !head.variables.empty())
    lines.push_back("VARIABLES = " + shortened(head.variables) + kFirst);
  return lines;
}

}  // namespace keyline::exchange::detail
