#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/document/planar_curve.h"

namespace keyline::document {

struct Joined {
  Path path;
  double gap = 0;                     ///< largest between neighbours
  std::vector<std::size_t> reversed;  ///< curves that run the other way in it
};

/// Curves end to end in one path: from the first on, each end goes on with the curve whose end is
/// nearest; where that leaves curves over, loops of them are put in where they pass (Hierholzer).
/// An order is found wherever there is one, if ends within `gap` of one end are so of each other.
/// Closed where the last end meets the first start within `gap`. Gaps that first_gap() finds are
/// closed by straight lines.
/// Precondition: not empty.
/// Fails: undrawable where the nearest end is farther than `gap`, with how far.
core::Result<Joined> joined(const std::vector<Path>& curves, double gap);

}  // namespace keyline::document
