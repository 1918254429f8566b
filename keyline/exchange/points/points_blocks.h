#pragma once

#include <string>
#include <vector>

#include "keyline/acquire/raw_curve.h"

namespace keyline::exchange::detail {

/// Blank lines among the rows of a table, one behind the other.
struct BlankLines {
  int first = 0;  ///< number of the first line
  int count = 0;
};

/// Blocks of rows, which blank lines part, become curves of their own, as gnuplot draws them, with
/// a note. They stay one curve, which `left_out` tells, where a block is a single row, or where no
/// step over a single blank line is as long as the two beside it together, none turns back, and no
/// block is closed: rows set in groups, or the two sides of an airfoil. Where every row stands by
/// itself, the lines mean nothing. Precondition: one curve whose source lines grow; `blanks` grow.
void part_blocks(std::vector<acquire::RawCurve>& curves, const std::vector<BlankLines>& blanks,
                 std::vector<std::string>& left_out);

}  // namespace keyline::exchange::detail
