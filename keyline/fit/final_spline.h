#pragma once

#include <optional>
#include <vector>

#include "keyline/core/interval.h"
#include "keyline/fit/least_squares_spline.h"

/// Internals of room fit: the spline of the knots found, on all the data, and how far it is off.
namespace keyline::fit::detail {

double sum_of_weights(const SplineData& data);

/// The least-squares spline of the knots. Where rounding puts them just beyond the limit of rank,
/// or their spline leaves the data, the closest pair loses one; empty only where the data do not
/// even carry a spline without knots.
std::optional<LeastSquaresSpline> final_fit(const SplineData& data, core::Interval domain,
                                            std::vector<double> knots, int order);

/// The closed curve of the knots, all in [0, 1), without some of them where data are too few, with
/// some between them where they are less than the three a loop needs; empty where the data do not
/// carry three. The parameters of the data lie in [0, 1), too: the first point stands at both ends.
std::optional<LeastSquaresSpline> closed_fit(const SplineData& open, std::vector<double> knots,
                                             int order);

struct Misfit {
  double sse = 0;  ///< weighted
  double rms = 0;
  double largest = 0;
};

/// Weighted squares and largest distance of the data from the spline.
Misfit misfit(const LeastSquaresSpline& spline, const SplineData& data);

/// Knots strictly inside the domain.
std::vector<double> interior_of(const LeastSquaresSpline& spline);

}  // namespace keyline::fit::detail
