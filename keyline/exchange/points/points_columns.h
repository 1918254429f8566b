#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/exchange/text/text_table.h"

namespace keyline::exchange::detail {

/// Which column holds what, counted from 0; kNone where absent.
struct PointsColumns {
  static constexpr int kNone = -1;
  int x = 0;
  int y = 1;
  int z = kNone;
  int weight = kNone;
  int id = kNone;
  int x2 = kNone;  ///< of a second curve in the same rows (points_sides.h)
  int y2 = kNone;

  bool two() const { return y2 != kNone; }
  bool own_x() const { return two() && x2 != x; }
  int last() const { return std::max({x, y, z, weight, id, x2, y2}); }
  bool takes(int column) const {
    return column == x || column == y || column == z || column == weight || column == id ||
           column == x2 || column == y2;
  }
};

/// True for names (plain_name) of which the axes, or a column asked for, are some.
bool is_points_header(const std::vector<std::string>& names, const PointsOptions& options);

/// Whether a column of that header names the curve of each row.
bool names_curves(const std::vector<std::string>& names, const PointsOptions& options);

/// The columns of a table with that header (empty: none) and so many fields in its first row;
/// text_id: the first field is a name.
/// Fails: bad_input where a column asked for is not there.
core::Result<PointsColumns> choose_columns(const std::vector<std::string>& names,
                                           const PointsOptions& options, std::size_t fields,
                                           bool text_id, const std::string& place);

/// Whether a word beside an axis' letter says that the column holds coordinates: "position".
bool is_coordinate_word(std::string_view word);

/// The first 40 characters without control characters, for messages and names.
std::string shortened(std::string_view text);

/// Whether all fields from that one on are numbers.
bool all_numbers(const std::vector<std::string_view>& fields, const TableStyle& style,
                 std::size_t from = 0);

/// True for a line among or behind the rows of a table that a person takes for text: it holds a
/// word and has not the shape of a row of `width` fields that starts with a number in `column`.
bool is_remark(const std::vector<std::string_view>& fields, TableStyle style, std::size_t column,
               std::size_t width);

/// Whether a line of text has as many fields as a row, all but one of them numbers with fractions.
bool is_like_row(const std::vector<std::string_view>& fields, TableStyle style, std::size_t width);

}  // namespace keyline::exchange::detail
