#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "keyline/core/error.h"

namespace keyline::exchange::detail {

/// Lists of points whose rows are not where the points are: PTX, whose head of ten lines has the
/// numbers of columns and rows, the scanner's place, its axes and the matrix to it. By its name, or
/// by that head, whatever the file is called.
class PointsKind {
 public:
  /// The next line. Fails: bad_input for the name of a PTX, and where the line is the first
  /// of its matrix.
  core::Result<void> take(std::string_view line, const std::string& file);

 private:
  std::size_t line_ = 0;  ///< of the head, so far as it is one
  bool is_head_ = true;
};

}  // namespace keyline::exchange::detail
