#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/exchange/points/points_columns.h"
#include "keyline/exchange/text/text_table.h"

namespace keyline::exchange::detail {

struct PointsRow {
  core::Point3 point;
  core::Point3 second;  ///< where columns.two(); NaN where the row ends before its columns
  double weight = 1;
  std::string id;
};

/// Fails: bad_input where a column holds no number, one that is too large, or is not there.
core::Result<PointsRow> row_of(const std::vector<std::string_view>& fields,
                               const PointsColumns& columns, const TableStyle& style,
                               const std::string& place);

/// The failure of a row of so few fields.
core::Failure too_few(std::size_t fields, const PointsColumns& columns, const std::string& place);

}  // namespace keyline::exchange::detail
