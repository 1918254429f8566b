#include "keyline/exchange/points/space_rows.h"

#include <algorithm>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/exchange/points/points_row.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange::detail {

using core::ErrorCode;

namespace {

core::Failure too_few_numbers(const std::string& place) {
  return {ErrorCode::bad_input, "three numbers (x y z) are needed here",
          "give every point all its coordinates", place};
}

/// Whether a line of text is rather a row of so many fields with a mistake in a number: "0 0 O.5".
bool is_row_amiss(const SpaceRows::Fields& fields, const TableStyle& style, std::size_t width) {
  const auto is_number = [&](std::string_view f) { return parse_number(f, style).has_value(); };
  const auto has_digit = [](std::string_view f) { return f.find_first_of("0123456789") != f.npos; };
  return fields.size() == width && std::ranges::any_of(fields, is_number) &&
         std::ranges::all_of(fields, [&](auto f) { return is_number(f) || has_digit(f); });
}

}  // namespace

core::Result<bool> SpaceRows::is_first(std::string_view line, int number,
                                       const std::string& place) {
  const std::size_t titles = head_.text_lines;
  const auto first = is_first_row(head_, options_, trimmed(line), number, place);
  if (!first) return first;
  if (!*first) {
    if (head_.text_lines > titles) title_ = {head_.last_text, place};
    return false;
  }
  const Fields row = split(line, head_.style);
  const std::size_t fewest = head_.text_id ? 4 : 3;
  if (is_bare() && row.size() < fewest) {
    constexpr std::size_t kMost = 2;  // lines of numbers before the points
    if (left_out_.size() == kMost) return std::unexpected(too_few_numbers(place));
    left_out_.push_back("line " + std::to_string(number) + ": " +
                        core::counted(row.size(), "number") + " before the points");
    return false;
  }
  if (auto done = start(row, line, place); !done) return std::unexpected(done.error());
  return true;
}

core::Result<void> SpaceRows::start(const Fields& first_row, std::string_view line,
                                    const std::string& place) {
  const auto columns = columns_below(head_, options_, first_row, place);
  if (!columns) return std::unexpected(columns.error());
  columns_ = *columns;
  if (columns_.z == PointsColumns::kNone)
    return core::fail(ErrorCode::bad_input, "these columns are not x, y and z of points in space",
                      "name those of all three, as with --columns 1,2,3", place);
  columns_.weight = columns_.id = PointsColumns::kNone;
  width_ = first_row.size();
  if (is_row_amiss(split(title_.text, head_.style), head_.style, width_))
    return core::fail(ErrorCode::bad_input,
                      "text where a number belongs: '" + shortened(title_.text) + "'",
                      "give numbers only, or start the line with #", title_.place);
  row_width_ = {first_row, line, head_.style, std::max(head_.names.size(), head_.headed)};
  auto unit = unit_below(head_, columns_, place, left_out_);
  if (!unit) return std::unexpected(unit.error());
  unit_ = std::move(*unit);
  auto told = left_out_above(head_);
  const bool all_told = head_.titles.empty() || (head_.unknown && head_.titles.size() == 1);
  if (!all_told) told.insert(told.begin(), head_.titles.front());  // which is no curve's name here
  if (options_.columns.empty()) {
    const auto beside = columns_beside(head_, columns_, further_columns(head_, width_));
    told.insert(told.end(), beside.begin(), beside.end());
  }
  left_out_.insert(left_out_.begin(), told.begin(), told.end());
  started_ = true;
  return {};
}

SpaceRows::Fields SpaceRows::fields(std::string_view line) {
  meet_fraction(head_, line);
  return split(line, head_.style);
}

core::Result<core::Point3> SpaceRows::point(const Fields& fields, std::string_view line,
                                            const std::string& place) {
  const auto row = row_of(fields, columns_, head_.style, place);
  if (!row) return std::unexpected(too_few_numbers(place));
  const auto behind = row_width_.check(fields, line, head_.style, place);
  if (!behind) return std::unexpected(behind.error());
  wider_ += *behind ? 1 : 0;
  return row->point;
}

std::vector<std::string> SpaceRows::left_out() const {
  std::vector<std::string> left = left_out_;
  if (wider_ > 0)
    left.push_back("of " + core::counted(wider_, "row") + " what stands behind column " +
                   std::to_string(row_width_.most()));
  return left;
}

bool SpaceRows::is_text(const Fields& fields) const {
  return is_remark(fields, head_.style, static_cast<std::size_t>(columns_.x), width_);
}

}  // namespace keyline::exchange::detail
