#pragma once

#include <cstddef>
#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/acquire/raw_curve.h"
#include "keyline/core/error.h"

namespace keyline::acquire::detail {

/// The points on their way through the steps: plane coordinates, weights (empty or as many), and
/// where each came from.
struct Working {
  std::vector<core::Point2> points;
  std::vector<double> weights;
  std::vector<std::size_t> sources;
  bool scattered = false;  ///< see RawCurve
};

/// Checks sizes of values and weights.
core::Result<void> check_input(const RawCurve& raw);

/// Indices of the points whose coordinates (and weights) are finite.
std::vector<std::size_t> finite_points(const RawCurve& raw);

/// Joins neighbours at the same place (within 1e-9 of the extent of the middle halves of the
/// coordinates), adding weights; returns how many went. The last point is kept even where it
/// repeats the first.
std::size_t merge_repeated(Working& work);

/// Removes the given indices (increasing).
void remove_points(Working& work, const std::vector<std::size_t>& indices);

}  // namespace keyline::acquire::detail
