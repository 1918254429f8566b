#pragma once

#include <vector>

#include "keyline/core/interval.h"
#include "keyline/fit/least_squares_spline.h"

/// Internals of room fit: splines that leave their data.
namespace keyline::fit::detail {

/// The bounding box of the data, one interval for each column, widened on every side by its longest
/// edge.
std::vector<core::Interval> room_about(const SplineData& data);

/// Whether the spline keeps within the room about its data from the first of them to the last, as
/// far as places tell at which every polynomial of its order comes to 1 / sqrt(2) of its largest
/// value or more.
bool stays_near(const LeastSquaresSpline& spline, const SplineData& data);

}  // namespace keyline::fit::detail
