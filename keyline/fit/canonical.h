#pragma once

#include <optional>
#include <span>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/fit/least_squares_spline.h"

/// The frame in which knots are searched, so that moving, turning, scaling or reversing data
/// does not send the search another way.
namespace keyline::fit::detail {

/// Data with parameters in [0, 1] and values of size about 1, rounded to multiples of 2^-34: what
/// differs by rounding alone becomes the same bits, hence the same search.
struct CanonicalData {
  SplineData data;
  double scale = 1;       ///< canonical value = scale * (turned value - offset)
  bool reversed = false;  ///< canonical parameter t is 1 - t of the data as given
};

/// A plane curve: origin at its first point, x axis to the centroid, size by the largest distance
/// from it; traversed so that the points of the later half lie farther from the centroid (ties: so
/// that the signed area is positive).
CanonicalData canonical_curve(std::span<const core::Point2> points,
                              const std::vector<double>& parameters,
                              const std::vector<double>& weights);

/// A function: parameters to [0, 1], values about their mean, scaled by the largest of them;
/// reversed likewise by where its values lie farther from the mean.
CanonicalData canonical_function(const std::vector<double>& x, const std::vector<double>& y,
                                 const std::vector<double>& weights);

/// Knots found in the canonical frame, as parameters in [0, 1] of the data as given.
std::vector<double> given_direction(const CanonicalData& canonical, std::vector<double> knots);

/// The largest power of ten of which all values are multiples to within their double precision,
/// or 0 where there is none with at most 12 significant digits: the rounding of decimal data.
double decimal_rounding(std::span<const double> values);

/// Data averaged into at most `bins` bins of equal width, weights added.
struct CondensedData {
  SplineData data;
  double scatter = 0;  ///< weighted squares about the line of each bin: what averaging hides
};
CondensedData condense(const SplineData& data, std::size_t bins);

}  // namespace keyline::fit::detail
