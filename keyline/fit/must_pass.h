#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/fit/least_squares_spline.h"

/// Points that a spline has to pass. Their weight draws it there only as far as its knots let it.
namespace keyline::fit::detail {

/// A point that must be passed: where, and its number among those given.
struct ToPass {
  double parameter = 0;
  std::vector<double> values;  ///< one for each column
  std::size_t number = 0;
};

/// The spline of some knots; empty where there is none.
using SplineOf = std::function<std::optional<LeastSquaresSpline>(const std::vector<double>& knots)>;

/// The spline of the knots; where it would miss a point, by more than a thousandth of what it is
/// off the others at most and than 1e-9 of their extent, with knots besides, or instead, at which
/// some spline interpolates the points. Empty where the knots have no spline.
/// Fails: not_converged, with the point that is missed most, where those miss one, too.
core::Result<std::optional<LeastSquaresSpline>> passing(const SplineOf& spline_of,
                                                        const std::vector<double>& knots,
                                                        const SplineData& data, bool closed,
                                                        const std::vector<ToPass>& points);

}  // namespace keyline::fit::detail
