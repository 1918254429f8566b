#pragma once

#include <vector>

#include "keyline/fairing/chain_fit.h"

namespace keyline::fairing::detail {

/// What the offsets of a run's points may be, as roots of mean squares.
struct Residuals {
  double rms = 0;      ///< expected of the points as they are fitted; 0: as the tolerance has it
  double noise = 0;    ///< of the same
  double scatter = 0;  ///< of measured points about the fitted ones that are their means
  double left = 0;     ///< what the tolerance holds beyond the errors
  double standard_error = 0;  ///< of the root of the mean square of all errors, a part of it
  /// What the root of the mean square may be: so many standard errors above what is expected of
  /// the measured points, less their scatter, which no curve changes.
  double most(double errors) const;
};

/// The tolerance holds n errors of the noise, as many standard deviations as the largest of them
/// takes (see default_tolerance); what it holds beyond is the curve's to depart by. With a
/// tolerance made for the noise nothing is left to spare, with a wide one nothing but the tolerance
/// counts.
///
/// The root of the mean square of n errors is the noise to within a standard error, and that is
/// allowed beside it: a curve that has to come nearer than its points are right bends after single
/// ones (the discrepancy principle, [Morozov 1966]).
///
/// Smoothness below 0.5 takes that share, twice, of what is left and of that allowance; above it
/// the mean square goes on to what the tolerance alone leaves.
///
/// points: as they are fitted, means of several where there are many; noise: of one measured point.
/// The rule is of the measured points, however many a mean holds: a mean errs by so little that a
/// curve as near as that would know the shape far better than the points are asked to.
Residuals allowed_residuals(const std::vector<FitPoint>& points, bool closed, std::size_t n,
                            double noise, double tolerance, double smoothness);

}  // namespace keyline::fairing::detail
