#pragma once

#include "keyline/core/point.h"

/// Where a curve ends where it begins.
namespace keyline::operations {

/// Ends are one place where they lie within this share of the curve's length.
inline constexpr double kOneEnd = 1e-6;
/// The same where an edit holds ends, and what is left between them would stay.
inline constexpr double kOneHeldEnd = 1e-9;

template <class Point>
bool meet(const Point& start, const Point& end, double length, double share = kOneEnd) {
  return core::distance(start, end) <= share * length;
}

}  // namespace keyline::operations
