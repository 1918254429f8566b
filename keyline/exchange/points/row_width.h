#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/exchange/text/text_table.h"

namespace keyline::exchange::detail {

/// Which columns the rows of a table have, as the first tells.
class RowWidth {
 public:
  using Fields = std::vector<std::string_view>;

  RowWidth() = default;
  /// The first row and its line; `named` columns have names.
  RowWidth(const Fields& fields, std::string_view line, const TableStyle& style, std::size_t named);

  /// Numbers behind the columns are let pass, except where commas separate: there they are rather
  /// what a decimal comma makes of one number, and the row would be read wrongly. So it would where
  /// a row has fewer columns, if the first has numbers there: which one is missing nobody knows.
  /// A first row may end before the columns that the header names, and others have them all.
  /// Returns: whether there are such numbers behind them. Fails: bad_input where the row has other
  /// columns than the first.
  core::Result<bool> check(const Fields& fields, std::string_view line, const TableStyle& style,
                           const std::string& place) const;

  /// Columns of the first row, or of the header if it has more.
  std::size_t most() const { return most_; }

 private:
  std::vector<bool> numbers_;  ///< which cells of the first row are some
  std::size_t most_ = 0;
};

}  // namespace keyline::exchange::detail
