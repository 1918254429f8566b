#include "keyline/exchange/points/points_row.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "keyline/core/coordinate.h"
#include "keyline/core/text.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange::detail {
namespace {

using core::ErrorCode;
using Fields = std::vector<std::string_view>;

/// A row with what it is read by.
struct Reader {
  const Fields& fields;
  const PointsColumns& columns;
  const TableStyle& style;
  const std::string& place;

  core::Result<double> number_in(int column) const;
  core::Result<core::Point3> second() const;
};

core::Result<double> Reader::number_in(int column) const {
  const auto k = static_cast<std::size_t>(column);
  // A missing last entry was dropped with the trailing separators.
  const std::string_view field = k < fields.size() ? fields[k] : std::string_view{};
  if (k > fields.size() || (k == fields.size() && style.separator == ' '))
    return std::unexpected(too_few(fields.size(), columns, place));
  const auto value = parse_number(field, style);
  if (!value) {
    return core::fail(ErrorCode::bad_input,
                      "text where a number belongs: '" + shortened(field) + "'",
                      "give a number, or choose other columns", place);
  }
  if (core::is_too_large(*value)) {
    return core::fail(ErrorCode::bad_input, "the number " + shortened(field) + " is too large",
                      "check the unit, or divide all coordinates by a common factor", place);
  }
  return *value;
}

/// The point of the second curve; none where the row ends before its columns.
core::Result<core::Point3> Reader::second() const {
  const auto begin = static_cast<std::size_t>(std::min(columns.x2, columns.y2));
  if (columns.own_x() && style.separator != ' ' && fields.size() <= begin) {
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    return core::Point3{kMissing, kMissing, 0};
  }
  const auto x = number_in(columns.x2);
  if (!x) return std::unexpected(x.error());
  const auto y = number_in(columns.y2);
  if (!y) return std::unexpected(y.error());
  return core::Point3{*x, *y, 0};
}

}  // namespace

core::Result<PointsRow> row_of(const Fields& fields, const PointsColumns& columns,
                               const TableStyle& style, const std::string& place) {
  const Reader reader{fields, columns, style, place};
  PointsRow row;
  const std::pair<int, double*> wanted[] = {{columns.x, &row.point.x},
                                            {columns.y, &row.point.y},
                                            {columns.z, &row.point.z},
                                            {columns.weight, &row.weight}};
  for (const auto& [column, target] : wanted) {
    if (column == PointsColumns::kNone) continue;
    const auto value = reader.number_in(column);
    if (!value) return std::unexpected(value.error());
    *target = *value;
  }
  if (columns.two()) {
    const auto second = reader.second();
    if (!second) return std::unexpected(second.error());
    row.second = *second;
  }
  const auto k = static_cast<std::size_t>(columns.id);
  if (columns.id == PointsColumns::kNone || k >= fields.size()) return row;
  const std::string_view id = fields[k];
  const bool quoted = id.size() >= 2 && id.front() == '"' && id.back() == '"';
  row.id = quoted ? unquoted(id) : std::string(id);
  return row;
}

core::Failure too_few(std::size_t fields, const PointsColumns& columns, const std::string& place) {
  return {ErrorCode::bad_input,
          "only " + std::to_string(fields) + " of at least " +
              core::counted(static_cast<std::size_t>(columns.last()) + 1, "column"),
          "give every point all its coordinates", place};
}

}  // namespace keyline::exchange::detail
