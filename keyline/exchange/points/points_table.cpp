#include "keyline/exchange/points/points_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/exchange/points/points_parts.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange::detail {
namespace {

using acquire::RawCurve;
using core::ErrorCode;

constexpr std::size_t kFewest = 3;  // rows that make a table beyond doubt

}  // namespace

core::Result<void> PointsTable::take(std::string_view line, int number, const std::string& place) {
  row_ = trimmed_in_front(line);
  line = trimmed(line);
  if (line.empty()) {
    meet_blank(number);
    return {};
  }
  if (!is_comment(line)) line = without_remark(line);
  const bool within = zone_ && goes_on_with_zone(line);
  zone_ = within || is_tecplot_zone(line);
  if (zone_ && is_zone_of_blocks(line))
    return core::fail(ErrorCode::bad_input, "a zone of Tecplot that is no list of points",
                      "write its points one to a row (DATAPACKING=POINT)", place);
  if (zone_ && !within) {
    if (auto all = zone_count_.check(rows_); !all) return all;
    zone_count_ = {rows_, place, {}};
  }
  if (zone_) zone_count_.take(line);
  if (within) return {};
  if (!started_) return before_data(line, number, place);
  if (is_comment(line) || is_behind_nodes(number)) return {};
  return among_data(line, number, place);
}

void PointsTable::meet_blank(int number) {
  if (!started_) return;
  if (!blanks_.empty() && blanks_.back().first + blanks_.back().count == number)
    ++blanks_.back().count;
  else
    blanks_.push_back({number, 1});
}

core::Result<void> PointsTable::before_data(std::string_view line, int number,
                                            const std::string& place) {
  const auto first = is_first_row(head_, options_, line, number, place);
  if (!first) return std::unexpected(first.error());
  return *first ? start(split(line, head_.style), number, place) : core::Result<void>{};
}

core::Result<void> PointsTable::start(const Fields& fields, int number, const std::string& place) {
  started_ = true;
  width_ = fields.size();
  first_line_ = number;
  const auto columns = columns_below(head_, options_, fields, place);
  if (!columns) return std::unexpected(columns.error());
  columns_ = nodes_ ? nodes_->columns() : *columns;
  first_row_ = numbers_of(fields, head_.style);
  row_width_ = {fields, row_, head_.style, std::max(head_.names.size(), head_.headed)};
  const auto unit = unit_below(head_, columns_, place, left_out_);
  if (!unit) return std::unexpected(unit.error());
  unit_ = *unit;
  if (options_.columns.empty()) ignored_columns_ = further_columns(head_, width_);
  if (nodes_) ignored_columns_ = nodes_->others;
  auto row = row_of(fields, columns_, head_.style, place);
  if (!row) return std::unexpected(row.error());
  counting_ = !nodes_ && head_.names.empty() && options_.columns.empty() && !head_.text_id &&
              columns_.z != PointsColumns::kNone;
  watch_counter(fields);
  add(*row, number);
  return {};
}

/// A row without what a comment's mark parts from its numbers: "0.5 0.1  ! tip". Where names of
/// curves stand in rows, the mark may be of one.
std::string_view PointsTable::without_remark(std::string_view line) {
  if (columns_.id != PointsColumns::kNone || names_curves(head_.names, options_)) return line;
  for (std::size_t at = line.find_first_of(" \t"); at != line.npos;
       at = line.find_first_of(" \t", at + 1)) {
    if (!is_comment(line.substr(at))) continue;
    const std::string_view row = trimmed(line.substr(0, at));
    const bool numbers = row.find_first_not_of("0123456789+-.,;eEdD \t") == row.npos &&
                         row.find_first_of(",;", row.size() - 1) == row.npos &&
                         row.find_first_of(",; \t") != row.npos;
    if (!numbers) return line;
    ++remarks_;
    return row;
  }
  return line;
}

core::Result<void> PointsTable::among_data(std::string_view line, int number,
                                           const std::string& place) {
  meet_fraction(head_, line);
  const Fields fields = split(line, head_.style);
  if (fields.empty()) {  // nothing but separators
    meet_blank(number);
    return {};
  }
  const auto x = static_cast<std::size_t>(columns_.x);
  const bool remark = columns_.id == PointsColumns::kNone
                          ? is_remark(fields, head_.style, x, width_)
                          : fields.size() < width_ && fields.size() <= x;
  if (remark || is_lone(fields)) return set_aside(fields, line, number, place);
  const auto nodes = is_first_of_many() ? node_counts(first_row_, fields, head_.style) : nodes_;
  if (first_was_none(fields) || nodes.has_value() != nodes_.has_value()) {
    restart(fields.size(), place);
    nodes_ = nodes;
    return before_data(line, number, place);
  }
  auto row = row_of(fields, columns_, head_.style, place);
  if (!row) return std::unexpected(row.error());
  if (nodes_ && !nodes_->is_next(fields, head_.style, rows_))
    return std::unexpected(nodes_->out_of_turn(fields, place));
  if (auto done = check_width(fields, number, place); !done) return done;
  if (remark_)
    if (auto again = take_up_again(); !again) return again;
  watch_counter(fields);
  add(*row, number);
  return {};
}

/// A number by itself where points have two and more: the count of the rows that follow, or behind
/// them all.
bool PointsTable::is_lone(const Fields& fields) const {
  return fields.size() == 1 && head_.style.separator == ' ' && columns_.last() > 0 &&
         columns_.id == PointsColumns::kNone && all_numbers(fields, head_.style);
}

core::Result<void> PointsTable::set_aside(const Fields& fields, std::string_view line, int number,
                                          const std::string& place) {
  if (auto all = meet_count(); !all) return all;
  remark_text_ = shortened(line);
  like_row_ = is_like_row(fields, head_.style, width_);
  if (is_lone(fields)) {
    if (run_ < kFewest && !remark_) return std::unexpected(too_few(1, columns_, place));
    count_ = {.rows = *parse_number(fields[0], head_.style),
              .failure = too_few(1, columns_, place)};
    remark_ = count_->failure;
  } else {
    remark_ = {ErrorCode::bad_input, "text where a number belongs: '" + remark_text_ + "'",
               "remove the line, or start it with #", place};
  }
  left_out_.push_back("line " + std::to_string(number) + ": " + remark_text_);
  return {};
}

/// A lone number with rows behind it has to be their count.
core::Result<void> PointsTable::meet_count() {
  const auto count = std::exchange(count_, std::nullopt);
  if (count && !remark_ && count->rows != static_cast<double>(run_))
    return std::unexpected(count->failure);
  return {};
}

core::Result<void> PointsTable::check_width(const Fields& fields, int number,
                                            const std::string& place) {
  if (columns_.own_x() && fields.size() <= row_width_.most())
    return {};  // the shorter side ends early
  const auto behind = row_width_.check(fields, row_, head_.style, place);
  if (!behind) return std::unexpected(behind.error());
  if (*behind)
    left_out_.push_back("line " + std::to_string(number) + ": what stands behind column " +
                        std::to_string(row_width_.most()));
  return {};
}

/// A first row of more or fewer numbers than the next, as the window before an airfoil's points or
/// the count before a list of points in space, is no point.
bool PointsTable::first_was_none(const Fields& fields) const {
  return is_first_of_many() && fields.size() >= 2 && fields.size() != width_ &&
         all_numbers(fields, head_.style);
}

/// Whether one row has been read so far, of columns that nothing but it has told.
bool PointsTable::is_first_of_many() const {
  const bool chosen = !head_.names.empty() || !options_.columns.empty() || head_.text_id || nodes_;
  return rows_ == 1 && !chosen && !remark_ && head_.style.separator == ' ';
}

/// Whether all nodes have been read that the first line counts; told once.
bool PointsTable::is_behind_nodes(int number) {
  if (!nodes_ || rows_ < nodes_->nodes) return false;
  if (!std::exchange(told_behind_, true))
    left_out_.push_back("line " + std::to_string(number) + ": what follows the " +
                        core::counted(nodes_->nodes, "node"));
  return true;
}

void PointsTable::restart(std::size_t fields, const std::string& place) {
  misfit_ = {
      ErrorCode::bad_input,
      core::counted(fields, "column") + " where the row before has " + std::to_string(width_),
      "give every point all its coordinates", place};
  left_out_.push_back("line " + std::to_string(first_line_) + ": " +
                      core::counted(width_, "number") + " before the rows of points");
  curves_.clear();
  seconds_.clear();
  index_.clear();
  current_ = 0;
  rows_ = run_ = 0;
  fourth_ = {};
  ignored_columns_ = 0;
  started_ = false;
}

/// Rows behind a line of text are a curve of its own where there are enough on both sides of it.
core::Result<void> PointsTable::take_up_again() {
  if (run_ < kFewest || unproven_ || columns_.id != PointsColumns::kNone || like_row_)
    return std::unexpected(unproven_ ? *unproven_ : *remark_);
  unproven_ = std::exchange(remark_, std::nullopt);
  left_out_.pop_back();  // it is the name of what follows
  run_ = 0;
  current_ = curves_.size();
  RawCurve curve;
  const std::string title = tecplot_title(remark_text_);
  if (!count_) curve.id = title.empty() ? remark_text_ : title;
  curve.has_z = columns_.z != PointsColumns::kNone;
  curves_.push_back(std::move(curve));
  return {};
}

/// Whether column 1 goes on counting the rows; what column 4 holds is kept as long as it does.
void PointsTable::watch_counter(const Fields& fields) {
  if (!counting_) return;
  counting_ = parse_number(fields[0], head_.style) == static_cast<double>(rows_ + 1) &&
              fields[0].find_first_of(".,") == fields[0].npos && fields.size() == width_;
  const auto fourth = fields.size() > 3 ? parse_number(fields[3], head_.style) : std::nullopt;
  fourth_.push_back(fourth.value_or(std::numeric_limits<double>::quiet_NaN()));
  if (!counting_) fourth_ = {};
}

/// Numbers of the points, which stand before fractions, are no coordinates.
void PointsTable::drop_counter() {
  if (!counting_ || curves_.size() != 1 || rows_ < kFewest) return;
  RawCurve& curve = curves_.front();
  const auto is_whole = [](const core::Point3& p) {
    return std::floor(p.y) == p.y && std::floor(p.z) == p.z;
  };
  if (std::ranges::all_of(curve.points, is_whole)) return;
  curve.has_z = width_ > 3;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    core::Point3& p = curve.points[i];
    p = {p.y, p.z, curve.has_z ? fourth_[i] : 0};
  }
  if (ignored_columns_ > 0) --ignored_columns_;
  left_out_.insert(left_out_.begin(),
                   "column 1, which counts the points (--columns 1,2,3 takes it for x)");
}

void PointsTable::tell_columns() {
  if (!options_.columns.empty()) return;
  const auto beside = columns_beside(head_, columns_, ignored_columns_);
  left_out_.insert(left_out_.begin(), beside.begin(), beside.end());
  if (remarks_ > 0)
    left_out_.insert(left_out_.begin(), "remarks behind " + core::counted(remarks_, "row"));
}

RawCurve& PointsTable::curve_of(std::string_view id) {
  if (columns_.id == PointsColumns::kNone && !curves_.empty()) return curves_[current_];
  if (!curves_.empty() && curves_[current_].id == id) return curves_[current_];
  const auto known = index_.find(id);
  if (known != index_.end()) {
    current_ = known->second;
  } else {
    current_ = curves_.size();
    index_.emplace(std::string(id), current_);
    RawCurve curve;
    curve.id = std::string(id);
    curve.has_z = columns_.z != PointsColumns::kNone;
    curves_.push_back(std::move(curve));
  }
  return curves_[current_];
}

/// Of sides that have an x each the shorter one has neither number at the end.
void PointsTable::add(const PointsRow& row, int number) {
  ++rows_;
  if (++run_ >= kFewest) unproven_.reset();
  const auto put = [&](RawCurve& curve, core::Point3 p) {
    if (columns_.own_x() && std::isnan(p.x) && std::isnan(p.y)) return;
    curve.points.push_back(p);
    curve.source_lines.push_back(number);
    if (columns_.weight != PointsColumns::kNone) curve.weights.push_back(row.weight);
  };
  put(curve_of(row.id), row.point);
  if (!columns_.two()) return;
  seconds_.resize(curves_.size());
  put(seconds_[current_], row.second);
}

/// Of a title that is a number: whether it counts the rows behind it, the points among them or
/// those of the first curve.
bool PointsTable::title_counts(double number) const {
  std::size_t points = 0;
  for (const auto& curve : curves_) points += curve.source_lines.size();
  const std::array counts = {rows_, points, curves_.front().source_lines.size()};
  return std::ranges::any_of(
      counts, [&](std::size_t count) { return number == static_cast<double>(count); });
}

/// A curve takes the title of its file, if that does not count its points; of several, those
/// without a name of their own.
void PointsTable::name_curves() {
  if (columns_.id != PointsColumns::kNone || head_.has_no_title()) return;
  const auto value = parse_number(head_.first_text, head_.style);
  const bool counts = value && title_counts(*value);
  const std::string title = counts ? std::string() : head_.first_text;
  if (value && !counts)
    left_out_.push_back("the number before the rows, " + head_.first_text +
                        ", counts none of them: taken for a title");
  std::size_t number = 0;
  for (RawCurve& curve : curves_) {
    ++number;
    if (curve.id.empty()) curve.id = number == 1 ? title : title + "#" + std::to_string(number);
  }
}

void PointsTable::tell_left_out() {
  if (!head_.has_no_title())
    for (RawCurve& curve : curves_)
      curve.notes.push_back(core::counted(head_.text_lines, "title line") + " before the points");
  tell_columns();
  const std::vector<std::string> above = left_out_above(head_);
  left_out_.insert(left_out_.begin(), above.begin(), above.end());
  left_out_ = core::told_in_part(std::move(left_out_), "further line");
  for (RawCurve& curve : curves_) curve.left_out = left_out_;
}

core::Result<PointsTable::Curves> PointsTable::finish(const std::string& name) {
  if (unproven_) return std::unexpected(*unproven_);
  if (nodes_ && rows_ < nodes_->nodes) return std::unexpected(nodes_->too_few(rows_, name));
  if (remark_ && rows_ < 2) return std::unexpected(*remark_);  // what is no row hides them
  if (auto all = meet_count(); !all) return std::unexpected(all.error());
  if (auto all = zone_count_.check(rows_); !all) return std::unexpected(all.error());
  if (misfit_ && !nodes_ && rows_ < kFewest) return std::unexpected(*misfit_);
  if (curves_.empty()) {
    const bool empty = head_.text_lines == 0 && head_.names.empty();
    return core::fail(
        ErrorCode::bad_input,
        empty ? "the file is empty"
              : "no points found" + (head_.first_text.empty()
                                         ? std::string()
                                         : " (it starts with '" + head_.first_text + "')"),
        "give a text file with two or three numbers on each line", name);
  }
  drop_counter();
  const bool named = columns_.id != PointsColumns::kNone;
  if (columns_.two()) {
    name_curves();
    curves_ = sides_of(std::move(curves_), std::move(seconds_), *head_.sides);
  } else if (named && options_.id_column.empty()) {
    join_named_points(curves_, columns_.id, left_out_);
  }
  const bool lines_part = !named && options_.blank_lines_part;
  curves_ = parts_of(std::move(curves_), head_.names.empty(),
                     lines_part ? blanks_ : std::vector<BlankLines>{}, left_out_);
  if (!columns_.two()) name_curves();
  tell_left_out();
  return std::move(curves_);
}

}  // namespace keyline::exchange::detail
