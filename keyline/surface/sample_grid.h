#pragma once

#include <vector>

#include "keyline/surface/surface.h"

namespace keyline::surface {

/// Jets to second order at rows x columns equally spaced parameters, borders included: row i lies
/// at u = i / (rows - 1), column j at v = j / (columns - 1).
struct JetGrid {
  int rows = 0;
  int columns = 0;
  std::vector<SurfaceJet> jets;  ///< row after row; third derivatives are zero

  const SurfaceJet& at(int i, int j) const {
    return jets[static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(j)];
  }
};

/// Largest number of points of a grid.
inline constexpr int kMostGridPoints = 16'777'216;

/// Rows are shared among threads (<= 0: all of the machine's); the result does not depend on how
/// many. Where there is no normal all but the point itself is as jet_with_normal() has it.
/// Throws InvalidInput unless rows, columns >= 2 and their product is at most kMostGridPoints.
JetGrid sample_grid(const Surface& s, int rows, int columns, int threads = 1);

}  // namespace keyline::surface
