#include "keyline/exchange/points_reader.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/exchange/lednicer.h"
#include "keyline/exchange/line_reader.h"
#include "keyline/exchange/text_table.h"

namespace keyline::exchange {
namespace {

using acquire::RawCurve;
using core::ErrorCode;
using detail::TableStyle;
using Fields = std::vector<std::string_view>;
using Curves = std::vector<RawCurve>;

constexpr double kLargest = 1e100;
constexpr int kNone = -1;

/// Which column holds what, counted from 0; kNone where absent.
struct Columns {
  int x = 0;
  int y = 1;
  int z = kNone;
  int weight = kNone;
  int id = kNone;

  int last() const { return std::max({x, y, z, weight, id}); }
};

std::string shortened(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, 40)) {
    out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return text.size() > 40 ? out + "..." : out;
}

int find_name(const std::vector<std::string>& names, std::initializer_list<const char*> wanted) {
  for (const char* name : wanted) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at != names.end()) return static_cast<int>(at - names.begin());
  }
  return kNone;
}

/// Reads lines one after the other into curves.
class PointsTable {
 public:
  explicit PointsTable(const PointsOptions& options) : options_(options) {}

  core::Result<void> take(std::string_view line, int number, const std::string& place);
  core::Result<Curves> finish(const std::string& name);

 private:
  core::Result<void> before_data(std::string_view line, int number, const std::string& place);
  core::Result<void> start(const Fields& fields, int number, const std::string& place);
  core::Result<void> data_row(const Fields& fields, int number, const std::string& place);
  core::Result<double> number_in(const Fields& fields, int column, const std::string& place) const;
  core::Result<int> column_named(const std::string& wanted, const std::string& place) const;
  core::Result<void> choose_columns(const Fields& fields, const std::string& place);
  bool is_header(const std::vector<std::string>& names) const;
  bool all_numbers(const Fields& fields, std::size_t from) const;
  bool is_junk(const Fields& fields) const;
  RawCurve& curve_of(std::string_view id);

  const PointsOptions& options_;
  TableStyle style_;
  Columns columns_;
  std::vector<std::string> names_;
  std::string first_text_;  // shortened
  std::string last_text_;
  bool unknown_header_ = false;
  bool started_ = false;
  bool text_id_ = false;
  std::size_t text_lines_ = 0;
  std::optional<std::string> junk_place_;
  std::size_t junk_lines_ = 0;
  std::size_t ignored_columns_ = 0;
  Curves curves_;
  std::map<std::string, std::size_t, std::less<>> index_;
  std::size_t current_ = 0;
};

bool PointsTable::all_numbers(const Fields& fields, std::size_t from) const {
  return std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(from), fields.end(),
                     [&](auto f) { return detail::parse_number(f, style_).has_value(); });
}

bool PointsTable::is_header(const std::vector<std::string>& names) const {
  if (names.size() < 2) return false;
  const auto named = [&](const char* name) { return find_name(names, {name}) != kNone; };
  const auto wanted = [&](const std::string& name) {
    return !name.empty() && find_name(names, {detail::plain_name(name).c_str()}) != kNone;
  };
  const bool axes = (named("x") && (named("y") || named("z"))) || (named("y") && named("z"));
  return axes || std::any_of(options_.columns.begin(), options_.columns.end(), wanted) ||
         wanted(options_.id_column) || wanted(options_.weight_column);
}

core::Result<void> PointsTable::take(std::string_view line, int number, const std::string& place) {
  line = detail::trimmed(line);
  if (line.empty()) return {};
  if (!started_) return before_data(line, number, place);
  if (detail::is_comment(line)) return {};
  const Fields fields = detail::split(line, style_);
  if (fields.empty()) return {};
  if (is_junk(fields)) {
    if (!junk_place_) junk_place_ = place;
    ++junk_lines_;
    return {};
  }
  if (junk_place_) {
    return core::fail(ErrorCode::bad_input, "text where a number belongs",
                      "remove the line, or start it with #", *junk_place_);
  }
  return data_row(fields, number, place);
}

/// Text after the points of an airfoil file: no number in it, and not a row of the table.
bool PointsTable::is_junk(const Fields& fields) const {
  if (columns_.id != kNone) return false;
  const bool numberless = std::none_of(fields.begin(), fields.end(), [&](auto f) {
    return !f.empty() && detail::parse_number(f, style_).has_value();
  });
  const bool row = static_cast<int>(fields.size()) > columns_.last();
  return numberless && (style_.separator == ' ' || !row);
}

core::Result<void> PointsTable::before_data(std::string_view line, int number,
                                            const std::string& place) {
  const bool comment = detail::is_comment(line);
  const std::string_view text = comment ? detail::comment_text(line) : line;
  if (!comment) {
    style_ = options_.separator == 0
                 ? detail::guess_style(line)
                 : TableStyle{options_.separator,
                              options_.separator != ',' && line.find(',') != line.npos};
    const Fields fields = detail::split(line, style_);
    if (!names_.empty() && names_.size() <= fields.size() + 1 && fields.size() >= 2) {
      return start(fields, number, place);
    }
    text_id_ = style_.separator != ' ' && fields.size() >= 3 && all_numbers(fields, 1) &&
               !detail::parse_number(fields[0], style_);
    if (fields.size() >= 2 && (text_id_ || all_numbers(fields, 0))) {
      return start(fields, number, place);
    }
    if (style_.separator != ' ' && fields.size() >= 2 && detail::parse_number(fields[0], style_) &&
        !fields[0].empty()) {
      return core::fail(ErrorCode::bad_input,
                        "text where a number belongs: '" + shortened(line) + "'",
                        "give numbers only, or start the line with #", place);
    }
  }
  // A header may be separated by a comma although rows are not, and the other way round.
  for (const char separator : {',', ';', '\t', ' '}) {
    std::vector<std::string> names;
    for (const auto field : detail::split(text, {separator, false})) {
      names.push_back(detail::plain_name(field));
    }
    if (is_header(names)) {
      names_ = std::move(names);
      return {};
    }
  }
  if (!comment) {
    if (first_text_.empty()) first_text_ = shortened(line);
    last_text_ = std::string(line.substr(0, 4096));
    ++text_lines_;
  }
  return {};
}

core::Result<int> PointsTable::column_named(const std::string& wanted,
                                            const std::string& place) const {
  const int named = find_name(names_, {detail::plain_name(wanted).c_str()});
  if (named != kNone) return named;
  const bool digits =
      !wanted.empty() && wanted.size() < 5 &&
      std::all_of(wanted.begin(), wanted.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (digits && std::stoi(wanted) >= 1) return std::stoi(wanted) - 1;
  std::string known;
  for (const std::string& name : names_) known += (known.empty() ? "" : ", ") + name;
  return core::fail(ErrorCode::bad_input, "there is no column '" + shortened(wanted) + "'",
                    known.empty() ? "the file has no header: give the number of the column"
                                  : "the columns are " + shortened(known),
                    place);
}

core::Result<void> PointsTable::choose_columns(const Fields& fields, const std::string& place) {
  columns_ = Columns{};
  if (!options_.columns.empty()) {
    if (options_.columns.size() < 2 || options_.columns.size() > 3) {
      return core::fail(ErrorCode::bad_input, "two or three columns are needed",
                        "name the columns of x, y and maybe z", "columns");
    }
    int* const wanted[] = {&columns_.x, &columns_.y, &columns_.z};
    for (std::size_t k = 0; k < options_.columns.size(); ++k) {
      const auto column = column_named(options_.columns[k], place);
      if (!column) return std::unexpected(column.error());
      *wanted[k] = *column;
    }
  } else if (!names_.empty()) {
    std::vector<int> found;
    for (const char* name : {"x", "y", "z"}) {
      const int column = find_name(names_, {name});
      if (column != kNone) found.push_back(column);
    }
    while (found.size() < 2) found.push_back(static_cast<int>(found.size()));
    columns_.x = found[0];
    columns_.y = found[1];
    if (found.size() > 2) columns_.z = found[2];
  } else {
    const int first = text_id_ ? 1 : 0;
    const int count = static_cast<int>(fields.size()) - first;
    columns_ = {first, first + 1, count >= 3 ? first + 2 : kNone, kNone, text_id_ ? 0 : kNone};
    ignored_columns_ = count > 3 ? static_cast<std::size_t>(count - 3) : 0;
  }
  if (columns_.weight == kNone) columns_.weight = find_name(names_, {"weight", "weights", "w"});
  if (columns_.id == kNone) columns_.id = find_name(names_, {"id", "curve", "name", "curve_id"});
  for (const auto& [name, target] : {std::pair{&options_.weight_column, &columns_.weight},
                                     std::pair{&options_.id_column, &columns_.id}}) {
    if (name->empty()) continue;
    const auto column = column_named(*name, place);
    if (!column) return std::unexpected(column.error());
    *target = *column;
  }
  return {};
}

core::Result<void> PointsTable::start(const Fields& fields, int number, const std::string& place) {
  started_ = true;
  unknown_header_ = text_lines_ > 0 && style_.separator != ' ' &&
                    detail::split(last_text_, style_).size() == fields.size();
  if (auto chosen = choose_columns(fields, place); !chosen) return chosen;
  return data_row(fields, number, place);
}

RawCurve& PointsTable::curve_of(std::string_view id) {
  if (!curves_.empty() && curves_[current_].id == id) return curves_[current_];
  const auto known = index_.find(id);
  if (known != index_.end()) {
    current_ = known->second;
  } else {
    current_ = curves_.size();
    index_.emplace(std::string(id), current_);
    RawCurve curve;
    curve.id = std::string(id);
    curve.has_z = columns_.z != kNone;
    curves_.push_back(std::move(curve));
  }
  return curves_[current_];
}

core::Result<double> PointsTable::number_in(const Fields& fields, int column,
                                            const std::string& place) const {
  const auto k = static_cast<std::size_t>(column);
  // A missing last entry was dropped with the trailing separators.
  const std::string_view field = k < fields.size() ? fields[k] : std::string_view{};
  if (k > fields.size() || (k == fields.size() && style_.separator == ' ')) {
    return core::fail(ErrorCode::bad_input,
                      "only " + std::to_string(fields.size()) + " of at least " +
                          std::to_string(columns_.last() + 1) + " columns",
                      "give every point all its coordinates", place);
  }
  const auto value = detail::parse_number(field, style_);
  if (!value) {
    return core::fail(ErrorCode::bad_input,
                      "text where a number belongs: '" + shortened(field) + "'",
                      "give a number, or choose other columns", place);
  }
  if (std::isfinite(*value) && std::abs(*value) > kLargest) {
    return core::fail(ErrorCode::bad_input, "the number " + shortened(field) + " is too large",
                      "check the unit, or divide all coordinates by a common factor", place);
  }
  return *value;
}

core::Result<void> PointsTable::data_row(const Fields& fields, int number,
                                         const std::string& place) {
  core::Point3 p;
  double weight = 1;
  const std::pair<int, double*> wanted[] = {
      {columns_.x, &p.x}, {columns_.y, &p.y}, {columns_.z, &p.z}, {columns_.weight, &weight}};
  for (const auto& [column, target] : wanted) {
    if (column == kNone) continue;
    const auto value = number_in(fields, column, place);
    if (!value) return std::unexpected(value.error());
    *target = *value;
  }
  std::string plain;
  std::string_view id;
  if (columns_.id != kNone) {
    const auto k = static_cast<std::size_t>(columns_.id);
    if (k < fields.size()) id = fields[k];
    if (id.size() >= 2 && id.front() == '"' && id.back() == '"') id = plain = detail::unquoted(id);
  }
  RawCurve& curve = curve_of(id);
  curve.points.push_back(p);
  curve.source_lines.push_back(number);
  if (columns_.weight != kNone) curve.weights.push_back(weight);
  return {};
}

core::Result<Curves> PointsTable::finish(const std::string& name) {
  if (curves_.empty()) {
    const bool empty = text_lines_ == 0 && names_.empty();
    return core::fail(ErrorCode::bad_input,
                      empty ? "the file is empty"
                            : "no points found" + (first_text_.empty()
                                                       ? std::string()
                                                       : " (it starts with '" + first_text_ + "')"),
                      "give a text file with two or three numbers on each line", name);
  }
  const bool title_is_header = unknown_header_ && text_lines_ == 1;
  if (curves_.size() == 1 && curves_[0].id.empty() && text_lines_ > 0 && !title_is_header) {
    curves_[0].id = first_text_;
  }
  if (curves_.size() == 1 && names_.empty()) detail::unfold_lednicer(curves_[0]);
  const auto note = [&](const std::string& text) {
    for (RawCurve& curve : curves_) curve.notes.push_back(text);
  };
  if (unknown_header_) note("the header names no x and y: the first columns taken");
  if (text_lines_ > 0 && !title_is_header)
    note(core::counted(text_lines_, "title line") + " before the points");
  if (junk_lines_ > 0) note(core::counted(junk_lines_, "text line") + " after the points ignored");
  if (ignored_columns_ > 0) {
    note(std::to_string(ignored_columns_) +
         " further column(s) ignored: x, y, z taken from the "
         "first three");
  }
  return std::move(curves_);
}

}  // namespace

core::Result<Curves> read_points(std::istream& in, const std::string& name,
                                 const PointsOptions& options) {
  LineReader lines(in, name, options.longest_line);
  PointsTable table(options);
  while (true) {
    bool end = false;
    const auto line = lines.next(end);
    if (!line) return std::unexpected(line.error());
    if (end) break;
    if (auto taken = table.take(*line, lines.number(), lines.place()); !taken) {
      return std::unexpected(taken.error());
    }
  }
  return table.finish(name);
}

core::Result<Curves> read_points(const std::filesystem::path& path, const PointsOptions& options) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return core::fail(ErrorCode::io, "this is a folder", "give a file", path.string());
  }
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    const int reason = errno;
    return core::fail(
        ErrorCode::io,
        "cannot be read: " + std::generic_category().message(reason == 0 ? EIO : reason),
        "check the name and the permissions", path.string());
  }
  return read_points(in, path.string(), options);
}

}  // namespace keyline::exchange
