#pragma once

#include <vector>

#include "keyline/core/point.h"

namespace keyline::sketch {

/// Points about `spacing` apart along the polygon, ends kept (closed: the first is not repeated),
/// with a value carried along. Repeated points count once; at least two points come out of an open
/// polygon of some length.
void resample(const std::vector<core::Point2>& points, const std::vector<double>& values,
              double spacing, bool closed, std::vector<core::Point2>& out,
              std::vector<double>& out_values);

/// Principal axis of points first … last: centre and unit direction (towards the last).
struct Axis {
  core::Point2 centre;
  core::Vector2 direction{1, 0};
  double largest_offset = 0;  ///< of a point from the axis
};
Axis principal_axis(const std::vector<core::Point2>& points, std::size_t first, std::size_t last);

}  // namespace keyline::sketch
