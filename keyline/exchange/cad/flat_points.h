#pragma once

#include <vector>

#include "keyline/core/point.h"

/// Points of space in the plane z = 0, and points of that plane in space.
namespace keyline::exchange::detail {

/// Share of their size by which points may leave the plane and count as in it: what rounding makes
/// of exact ones.
inline constexpr double kFlat = 1e-12;

bool are_flat(const std::vector<core::Point3>& points);
std::vector<core::Point2> flat(const std::vector<core::Point3>& points);
inline core::Point3 lifted(core::Point2 p) { return {p.x, p.y, 0}; }
std::vector<core::Point3> lifted(const std::vector<core::Point2>& points);

}  // namespace keyline::exchange::detail
