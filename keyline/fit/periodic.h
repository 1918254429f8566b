#pragma once

#include <optional>
#include <vector>

#include "keyline/fit/least_squares_spline.h"

namespace keyline::fit::detail {

/// Least-squares spline of period 1 with the given knots in [0, 1) (at least one), for data with
/// parameters in [0, 1], written with clamped ends. Empty where some knots have too few data
/// between them.
std::optional<LeastSquaresSpline> periodic_spline(const SplineData& data,
                                                  const std::vector<double>& knots, int order);

}  // namespace keyline::fit::detail
