#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/exchange/points/points_columns.h"
#include "keyline/exchange/points/points_head.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/exchange/points/row_width.h"

namespace keyline::exchange::detail {

/// Points in space under the head that tables have, one row at a time: of clouds and lattices.
class SpaceRows {
 public:
  using Fields = std::vector<std::string_view>;

  /// Lines are given with the tabs at their ends. Of the options the columns count.
  explicit SpaceRows(const PointsOptions& options) : options_(options) {}

  /// Takes a line before the points, unless it is the first of them.
  /// Returns: whether it is. Fails: bad_input where x, y and z are not all named, where the line
  /// of text before it is rather a row with a mistake in it, where three lines have too few
  /// numbers, and as is_first_row() and columns_below().
  core::Result<bool> is_first(std::string_view line, int number, const std::string& place);

  bool started() const { return started_; }
  /// The fields of a row.
  Fields fields(std::string_view line);
  /// Fails: bad_input where it has not three numbers, or other columns than the first.
  core::Result<core::Point3> point(const Fields& fields, std::string_view line,
                                   const std::string& place);
  /// Whether a row is none but a line of text among or behind them.
  bool is_text(const Fields& fields) const;

  /// Whether nothing tells how many columns there are.
  bool is_bare() const { return head_.names.empty() && options_.columns.empty(); }
  /// Of documents, as the head tells it; else empty.
  const std::string& unit() const { return unit_; }
  /// What of the head and of the columns is not taken, in words.
  std::vector<std::string> left_out() const;

 private:
  struct Title {  // the last line of text before the points
    std::string text;
    std::string place;
  };

  core::Result<void> start(const Fields& first_row, std::string_view line,
                           const std::string& place);

  PointsOptions options_;
  PointsHead head_;
  Title title_;
  PointsColumns columns_;
  std::size_t width_ = 0;  ///< fields of the first row
  RowWidth row_width_;
  std::size_t wider_ = 0;  ///< rows with numbers behind the columns
  std::string unit_;
  std::vector<std::string> left_out_;
  bool started_ = false;
};

}  // namespace keyline::exchange::detail
