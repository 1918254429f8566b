#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "keyline/acquire/raw_curve.h"
#include "keyline/core/error.h"
#include "keyline/core/point.h"

namespace keyline::acquire {

/// Range data: rows x columns of points, row after row. Non-finite points are holes.
struct Lattice {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<core::Point3> points;  ///< rows * columns
};

/// One row (column) of the lattice as a curve in its order, counted from 0.
/// Returns bad-input where there is no such row (column) or points do not match rows * columns.
core::Result<RawCurve> lattice_row(const Lattice& lattice, std::size_t row);
core::Result<RawCurve> lattice_column(const Lattice& lattice, std::size_t column);

}  // namespace keyline::acquire
