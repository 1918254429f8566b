#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"

namespace keyline::surface {

/// Control points of a tensor product patch, row after row. The first index counts rows and goes
/// with the parameter u, the second counts the points of a row and goes with v.
struct Net {
  int rows = 0;
  int columns = 0;
  std::vector<core::Point3> points;  ///< rows * columns

  core::Point3& at(int row, int column) { return points[index(row, column)]; }
  const core::Point3& at(int row, int column) const { return points[index(row, column)]; }
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  friend bool operator==(const Net&, const Net&) = default;
};

/// Points of the row, along v; of the column, along u.
std::vector<core::Point3> row_of(const Net& net, int row);
std::vector<core::Point3> column_of(const Net& net, int column);

/// The net with rows and columns exchanged.
Net transposed(const Net& net);

/// Fails with bad_input and a path such as "points[2][0]" or "weights[1][3]" unless there are two
/// or more rows and columns, as many points as that makes, all finite, and weights are absent or
/// one per point, positive and finite.
core::Result<void> validate(const Net& net, const std::vector<double>& weights);

/// Diagonal of the box around the points: the size tolerances of a patch are measured by.
double extent(const Net& net);

}  // namespace keyline::surface
