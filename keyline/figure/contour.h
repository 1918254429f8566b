#pragma once

#include <vector>

#include "keyline/core/point.h"

namespace keyline::figure {

/// Values on a regular grid; row 0 lies at low.y, values are row by row. NaN: no value there.
struct Grid {
  core::Point2 low = {};
  core::Point2 high = {1, 1};
  int columns = 0;
  int rows = 0;
  std::vector<double> values = {};
};

/// Lines along which the bilinear surface over the grid has the value `level` (marching squares,
/// saddles decided by the mean of their corners). Closed lines end where they start. Cells with a
/// corner that has no value are left out. Throws InvalidInput where the counts do not agree.
std::vector<std::vector<core::Point2>> contour_lines(const Grid& grid, double level);

/// `count` levels that each leave about as many grid values between them and the next.
std::vector<double> even_levels(const Grid& grid, int count);

}  // namespace keyline::figure
