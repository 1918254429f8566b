#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::acquire::detail {

/// For each point the index of the first one at exactly its place: its own, unless it repeats an
/// earlier one. Coordinates are finite. O(n log n).
std::vector<std::size_t> first_at_place(std::span<const core::Point2> points);
std::vector<std::size_t> first_at_place(std::span<const core::Point3> points);

}  // namespace keyline::acquire::detail
