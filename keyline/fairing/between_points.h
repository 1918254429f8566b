#pragma once

#include <vector>

#include "keyline/core/point.h"

namespace keyline::fairing::detail {

/// Place between points i and i + 1, at share u of the way, on the centripetal Catmull-Rom curve
/// through the points (Barry and Goldman's pyramid).
core::Point2 between_points(const std::vector<core::Point2>& points, bool closed, std::size_t i,
                            double u);

}  // namespace keyline::fairing::detail
