#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>

#include "keyline/core/coordinate.h"
#include "keyline/core/leading_number.h"
#include "keyline/core/text.h"
#include "keyline/document/document.h"
#include "keyline/exchange/points/hull_table.h"
#include "keyline/exchange/points/points_columns.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/byte_lines.h"
#include "keyline/exchange/text/header_unit.h"
#include "keyline/exchange/text/text_table.h"
#include "keyline/exchange/text/utf16.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;

constexpr double kOutside = std::numeric_limits<double>::quiet_NaN();

/// A whole number that ends at `stop` (or the end for 0), taken off the text.
std::optional<int> take_whole(std::string_view& text, char stop) {
  const auto value = core::take_whole<int>(text);
  if (!value || *value < 0) return std::nullopt;
  if (stop == '\0') return value;
  if (!text.starts_with(stop)) return std::nullopt;
  text.remove_prefix(1);
  return value;
}

/// Feet-inches-eighths as shipyards write offsets.
std::optional<double> feet_of(std::string_view text) {
  const auto feet = take_whole(text, '-');
  const auto inches = feet ? take_whole(text, '-') : std::nullopt;
  const auto eighths = inches ? take_whole(text, '\0') : std::nullopt;
  if (!eighths || *inches >= 12 || *eighths >= 8) return std::nullopt;
  const double sixteenth = text == "+" ? 0.5 : text == "-" ? -0.5 : text.empty() ? 0 : NAN;
  if (std::isnan(sixteenth)) return std::nullopt;
  return *feet + (*inches + (*eighths + sixteenth) / 8) / 12;
}

/// "3 1/2" or "1/2".
std::optional<double> fraction_of(std::string_view text) {
  double whole = 0;
  if (text.find(' ') != text.npos) {
    const auto first = take_whole(text, ' ');
    if (!first) return std::nullopt;
    whole = *first;
  }
  const auto over = take_whole(text, '/');
  const auto under = over ? take_whole(text, '\0') : std::nullopt;
  if (!under || *under == 0 || !text.empty()) return std::nullopt;
  return whole + static_cast<double>(*over) / *under;
}

constexpr std::array<std::string_view, 4> kStations = {"station", "stations", "st", "sta"};
constexpr std::array<std::string_view, 3> kWaterlines = {"waterline", "waterlines", "wl"};

class HullCsv {
 public:
  explicit HullCsv(std::string_view text) : lines_(text) {}

  /// Reads up to the line of the axis across; false where there is none near the start.
  bool find_header() {
    constexpr std::size_t kFarthest = 20;
    std::string_view line;
    while (lines_.number() < kFarthest && lines_.next(line)) {
      if (detail::trimmed(line).empty() || detail::is_comment(line)) continue;
      const bool semicolon = line.find(';') != line.npos;
      const char separator = semicolon ? ';' : line.find('\t') != line.npos ? '\t' : ',';
      style_ = {separator, semicolon};
      header_ = detail::split(line, style_);
      if (header_.empty()) continue;  // nothing but separators
      if (is_axis(header_.front()) && header_.size() > 1) return true;
      if (header_.size() > 2) return false;
      take_unit(header_.back());
    }
    return false;
  }

  /// True for the header of a table: numbers behind our own words, nothing but two or more behind
  /// others.
  bool is_table() {
    const auto is_number = [this](std::string_view cell) {
      const auto value = at_axis(cell, !by_station_);
      return value && std::isfinite(*value);
    };
    const bool plain = header_.front() == "waterline" || header_.front() == "station";
    if (plain) return std::any_of(header_.begin() + 1, header_.end(), is_number);
    return header_.size() > 2 && std::all_of(header_.begin() + 1, header_.end(), is_number);
  }

  Result<HullTable> read() {
    if (!other_unit_.empty())
      return fail(ErrorCode::bad_input, "the table is in two units, one of them " + other_unit_,
                  "give one", lines_.place());
    const auto across = axis_across();
    if (!across) return std::unexpected(across.error());
    if (!std::all_of(across->begin(), across->end(), [](double v) { return std::isfinite(v); }))
      return fail(ErrorCode::bad_input, "the first line needs a number in every column", "mend it",
                  lines_.place());
    std::vector<double> down;
    std::vector<std::vector<double>> rows;
    std::string_view line;
    std::set<double> seen;
    std::string remark;  // the place of text behind rows
    while (lines_.next(line)) {
      if (detail::trimmed(line).empty() || detail::is_comment(line)) continue;
      const auto fields = detail::split(line, style_);
      if (fields.empty()) continue;
      const auto at = at_axis(fields.front(), by_station_);
      if (!at && !rows.empty() && detail::is_remark(fields, style_, 0, header_.size())) {
        if (remark.empty()) remark = lines_.place();
        left_out_.push_back(lines_.place() + ": " + detail::shortened(detail::trimmed(line)));
        continue;
      }
      if (!remark.empty())
        return fail(ErrorCode::bad_input, "this row does not fit the first line", "mend it",
                    remark);
      auto row = numbers(fields);
      if (!row) return std::unexpected(row.error());
      if (!at || !std::isfinite(*at) || row->size() > across->size())
        return fail(ErrorCode::bad_input, "this row does not fit the first line", "mend it",
                    lines_.place());
      if (!seen.insert(*at).second) return stands_twice(by_station_);
      tell_missing(line, across->size());
      row->resize(across->size(), kOutside);
      down.push_back(*at);
      rows.push_back(std::move(*row));
    }
    if (rows.empty())
      return fail(ErrorCode::bad_input, "the table has no rows", "give some", lines_.place());
    return table(*across, down, rows);
  }

 private:
  std::unexpected<core::Failure> stands_twice(bool station) const {
    return fail(ErrorCode::bad_input,
                station ? "a station stands twice" : "a waterline stands twice", "leave one out",
                lines_.place());
  }

  /// Cells that a line has fewer behind its first than it should, empty ones at its end among them.
  void tell_missing(std::string_view line, std::size_t cells) {
    const auto there = static_cast<std::size_t>(std::ranges::count(line, style_.separator));
    if (there < cells)
      left_out_.push_back(lines_.place() + ": " + core::counted(cells - there, "cell") +
                          " fewer than in the first line: outside the hull");
  }

  bool is_axis(std::string_view cell) {
    const std::string name = detail::plain_name(cell);
    const auto starts = [&name](std::string_view word) {
      if (!name.starts_with(word)) return false;
      const char next = name.size() > word.size() ? name[word.size()] : ' ';
      return !(next >= 'a' && next <= 'z') && !(next >= '0' && next <= '9');
    };
    by_station_ = std::ranges::any_of(kStations, starts);
    const bool waterline = std::ranges::any_of(kWaterlines, starts);
    const std::size_t open = cell.find_first_of("([");
    if (open != cell.npos)
      take_unit(cell.substr(open + 1, cell.find_first_of(")]", open) - open - 1));
    return by_station_ || waterline;
  }

  void take_unit(std::string_view text) {
    const std::string unit =
        detail::unit_in_words(text.substr(text.find(':') == text.npos ? 0 : text.find(':') + 1));
    if (unit.empty()) return;
    if (!unit_.empty() && unit_ != unit) other_unit_ = unit;
    unit_ = unit;
  }

  std::optional<double> number(std::string_view field) {
    if (const auto plain = detail::parse_number(field, style_)) return plain;
    if (field.find_first_not_of("-\u2013\u2014.") == field.npos) return kOutside;
    if (const auto feet = feet_of(field)) {
      if (unit_.empty()) unit_ = "ft";
      return unit_ == "ft" ? feet : std::nullopt;
    }
    return fraction_of(field);
  }

  /// A station or waterline, maybe with its name before the number: "WL 1.5".
  std::optional<double> at_axis(std::string_view cell, bool station) {
    if (const auto plain = number(cell)) return plain;
    std::size_t digits = cell.find_first_of("0123456789");
    if (digits == cell.npos || digits == 0) return std::nullopt;
    if (cell[digits - 1] == '-' || cell[digits - 1] == '.') --digits;
    const std::string name = detail::lower_case(detail::trimmed(cell.substr(0, digits)));
    const bool known = station ? std::ranges::find(kStations, name) != kStations.end()
                               : std::ranges::find(kWaterlines, name) != kWaterlines.end();
    return known ? number(cell.substr(digits)) : std::nullopt;
  }

  /// The numbers of the first line; those behind names are told, as they might only count.
  Result<std::vector<double>> axis_across() {
    std::vector<double> values;
    std::set<double> seen;
    for (std::size_t k = 1; k < header_.size(); ++k) {
      const auto value = at_axis(header_[k], !by_station_);
      if (!value || std::abs(*value) > core::kLargestCoordinate) return misplaced(k);
      if (std::isfinite(*value) && !seen.insert(*value).second) return stands_twice(!by_station_);
      values.push_back(*value);
    }
    if (header_.size() > 1 && !number(header_[1]))
      left_out_.push_back(lines_.place() + ": the number in \"" + detail::shortened(header_[1]) +
                          "\" and its like is taken for the " +
                          (by_station_ ? "height of a waterline" : "position of a station"));
    return values;
  }

  std::unexpected<core::Failure> misplaced(std::size_t column) const {
    return fail(ErrorCode::bad_input,
                "a number is expected in column " + std::to_string(column + 1),
                "mend it, or leave it empty outside the hull", lines_.place());
  }

  /// The numbers behind a row's first cell.
  Result<std::vector<double>> numbers(const std::vector<std::string_view>& fields) {
    std::vector<double> values;
    for (std::size_t k = 1; k < fields.size(); ++k) {
      const auto value = number(fields[k]);
      if (!value || std::abs(*value) > core::kLargestCoordinate) return misplaced(k);
      if (*value < 0)
        return fail(ErrorCode::bad_input,
                    "the half-breadth in column " + std::to_string(k + 1) + " is negative",
                    "mend it, or leave it empty outside the hull", lines_.place());
      values.push_back(*value);
    }
    return values;
  }

  /// Indices that put the values in order.
  static std::vector<std::size_t> order_of(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    return order;
  }

  HullTable table(const std::vector<double>& across, const std::vector<double>& down,
                  const std::vector<std::vector<double>>& rows) const {
    const auto columns = order_of(across);
    const auto order = order_of(down);
    HullTable made;
    made.unit = unit_;
    made.left_out = left_out_;
    for (const std::size_t i : by_station_ ? columns : order)
      made.waterlines.push_back(by_station_ ? across[i] : down[i]);
    for (const std::size_t i : by_station_ ? order : columns)
      made.stations.push_back(by_station_ ? down[i] : across[i]);
    for (const std::size_t i : by_station_ ? columns : order)
      for (const std::size_t k : by_station_ ? order : columns)
        made.half_breadth.push_back(by_station_ ? rows[k][i] : rows[i][k]);
    return made;
  }

  detail::ByteLines lines_;
  detail::TableStyle style_;
  std::vector<std::string_view> header_;
  std::string unit_;
  std::string other_unit_;  ///< that differs from the one before it
  std::vector<std::string> left_out_;
  bool by_station_ = false;
};

}  // namespace

bool is_hull_csv(std::string_view head) {
  HullCsv csv(detail::without_mark(head));
  return csv.find_header() && csv.is_table();
}

Result<HullTable> read_hull_csv(std::string_view text) {
  HullCsv csv(detail::without_mark(text));
  if (!csv.find_header())
    return fail(ErrorCode::bad_input, "this is no table of offsets",
                "start it with \"waterline\" and the stations", "line 1");
  return csv.read();
}

}  // namespace keyline::exchange
