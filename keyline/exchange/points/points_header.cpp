#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "keyline/core/text.h"
#include "keyline/exchange/points/points_table.h"
#include "keyline/exchange/text/ascii.h"

/// What stands before the rows of a table: titles, a header with names and units, the first row.
namespace keyline::exchange::detail {

using core::ErrorCode;

void PointsTable::remember_title(std::string_view line, int number) {
  constexpr std::size_t kMostKept = 100;
  if (titles_.size() < kMostKept)
    titles_.push_back("line " + std::to_string(number) + ": " + shortened(line));
  if (first_text_.empty()) first_text_ = shortened(line);
  last_text_ = std::string(line.substr(0, 4096));
  ++text_lines_;
}

/// Tabs part fields where a header's do so, or where the first is a name; elsewhere they are white
/// space as any other, of which there may be several in a row.
bool PointsTable::tabs_part(std::string_view line) const {
  const Fields fields = split(line, {'\t', style_.decimal_comma});
  if (fields.size() < 2) return false;
  if (!names_.empty()) return header_separator_ == '\t' && fields.size() <= names_.size();
  return fields.size() >= 3 && !parse_number(fields[0], style_) && all_numbers(fields, 1);
}

void PointsTable::take_style(std::string_view line) {
  style_ = options_.separator == 0
               ? guess_style(line)
               : TableStyle{options_.separator,
                            options_.separator != ',' && line.find(',') != line.npos};
  if (options_.separator == 0 && style_.separator == ' ' && tabs_part(line))
    style_.separator = '\t';
  fraction_known_ =
      style_.separator == ',' || style_.separator == ' ' || line.find_first_of(".,") != line.npos;
}

/// A header may be separated by a comma although rows are not, and the other way round.
bool PointsTable::take_header(std::string_view text, int number, bool comment) {
  for (const char separator : {',', ';', '\t', ' '}) {
    std::vector<std::string> names;
    std::vector<HeaderUnit> units;
    const Fields cells = split(text, {separator, false});
    for (const auto field : cells) {
      names.push_back(plain_name(field));
      units.push_back(unit_of(field));
    }
    auto sides = find_sides(cells, separator == ' ');
    if (!sides && !is_points_header(names, options_)) continue;
    sides_ = std::move(sides);
    names_ = std::move(names);
    units_ = std::move(units);
    header_separator_ = separator;
    header_counts_ = comment;
    header_line_ = number;
    return true;
  }
  return false;
}

/// A second line of a header, of units alone: "mm,mm", "[m];[m];-".
bool PointsTable::take_unit_row(std::string_view text, int number) {
  if (names_.empty()) return false;
  const Fields fields = split(text, {header_separator_, false});
  if (fields.size() < 2 || fields.size() > names_.size()) return false;
  std::vector<HeaderUnit> units;
  for (const std::string_view field : fields) {
    if (parse_number(field, style_) && !field.empty()) return false;
    units.push_back(unit_alone(field));
  }
  const auto says = [](const HeaderUnit& u) { return !u.known.empty() || !u.unknown.empty(); };
  if (std::ranges::none_of(units, says)) return false;
  for (std::size_t i = 0; i < units.size(); ++i)
    if (says(units[i])) units_[i] = units[i];
  header_line_ = number;
  return true;
}

core::Result<void> PointsTable::before_data(std::string_view line, int number,
                                            const std::string& place) {
  const bool comment = is_comment(line);
  const std::string_view text = comment ? comment_text(line) : line;
  if (take_unit_row(text, number) || lower_case(text).starts_with("sep=")) return {};
  if (!comment) {
    take_style(line);
    const Fields fields = split(line, style_);
    if (!names_.empty() && names_.size() <= fields.size() + 1 && fields.size() >= 2) {
      return start(fields, number, place);
    }
    text_id_ = style_.separator != ' ' && fields.size() >= 3 && all_numbers(fields, 1) &&
               !parse_number(fields[0], style_);
    if (fields.size() >= 2 && (text_id_ || all_numbers(fields, 0))) {
      return start(fields, number, place);
    }
    const auto first = fields.empty() ? std::nullopt : parse_number(fields[0], style_);
    if (style_.separator != ' ' && fields.size() >= 2 && first && !std::isnan(*first)) {
      return core::fail(ErrorCode::bad_input,
                        "text where a number belongs: '" + shortened(line) + "'",
                        "give numbers only, or start the line with #", place);
    }
  }
  if (take_header(text, number, comment)) return {};
  if (const std::string unit = unit_said(text); !unit.empty()) {
    said_unit_ = unit;
    if (lower_case(text).starts_with("unit")) return {};  // it says nothing else
  }
  if (!comment) remember_title(line, number);
  return {};
}

/// The unit that the header gives the coordinates.
core::Result<void> PointsTable::take_units(const std::string& place) {
  for (const int column : {columns_.x, columns_.y, columns_.z, columns_.x2, columns_.y2}) {
    if (column < 0 || static_cast<std::size_t>(column) >= units_.size()) continue;
    const auto& [known, unknown] = units_[static_cast<std::size_t>(column)];
    if (!unknown.empty() && unit_.empty())
      left_out_.push_back("line " + std::to_string(header_line_) + ": the unit " +
                          shortened(unknown) + ", which is none of mm, cm, m, km, in, ft, pt, px");
    if (known.empty()) continue;
    if (!unit_.empty() && unit_ != known)
      return core::fail(ErrorCode::bad_input,
                        "the header gives the coordinates two units, " + unit_ + " and " + known,
                        "give all coordinates in one", place);
    unit_ = known;
  }
  if (unit_.empty()) unit_ = said_unit_;
  return {};
}

namespace {

/// Whether a row below a header of so many names has two fields for each number and no fraction:
/// what decimal commas make of it.
bool has_decimal_commas(const std::vector<std::string_view>& fields, std::size_t named,
                        const TableStyle& style) {
  const auto texts = static_cast<std::size_t>(
      std::ranges::count_if(fields, [&](auto f) { return !f.empty() && !parse_number(f, style); }));
  return style.separator == ',' && named >= 2 && fields.size() > named &&
         fields.size() + texts == 2 * named &&
         std::ranges::all_of(fields, [](auto f) { return f.find('.') == f.npos; });
}

core::Result<void> too_wide(std::size_t columns, std::size_t named, const std::string& place) {
  return core::fail(ErrorCode::bad_input,
                    std::to_string(columns) + " columns below a header of " + std::to_string(named),
                    "where numbers have a decimal comma, separate columns by ; or blanks", place);
}

}  // namespace

core::Result<void> PointsTable::start(const Fields& fields, int number, const std::string& place) {
  started_ = true;
  width_ = fields.size();
  // "# x y" over rows that begin with 1: the mark of a comment is a column's name
  if (header_counts_ && fields.size() == names_.size() + 1 && fields[0] == "1") {
    names_.insert(names_.begin(), "#");
    units_.insert(units_.begin(), HeaderUnit{});
    if (sides_)
      for (int* column : {&sides_->first.x, &sides_->first.y, &sides_->second.x, &sides_->second.y})
        ++*column;
  }
  first_line_ = number;
  // Words between spaces are a title; a line with tabs heads columns, which tabs or spaces part.
  const bool tabs = last_text_.find('\t') != std::string::npos;
  const TableStyle heads = tabs && style_.separator == ' ' ? TableStyle{'\t', false} : style_;
  const std::size_t headed =
      text_lines_ > 0 && heads.separator != ' ' ? split(last_text_, heads).size() : 0;
  unknown_header_ = headed == fields.size();
  most_ = std::max({width_, names_.size(), headed});
  const std::size_t named = names_.empty() ? headed : names_.size();
  if (has_decimal_commas(fields, named, style_)) return too_wide(width_, named, place);
  const auto chosen = choose_columns(names_, options_, width_, text_id_, place);
  if (!chosen) return std::unexpected(chosen.error());
  columns_ = *chosen;
  take_sides();
  if (auto taken = take_units(place); !taken) return taken;
  const std::size_t known = !names_.empty() ? names_.size() : text_id_ ? 4 : 3;
  if (options_.columns.empty()) ignored_columns_ = width_ - std::min(width_, known);
  auto row = row_of(fields, place);
  if (!row) return std::unexpected(row.error());
  counting_ =
      names_.empty() && options_.columns.empty() && !text_id_ && columns_.z != PointsColumns::kNone;
  watch_counter(fields);
  add(std::move(*row), number);
  return {};
}

}  // namespace keyline::exchange::detail
