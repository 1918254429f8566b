#pragma once

#include <vector>

#include "keyline/fairing/chain_fit.h"

namespace keyline::fairing::detail {

/// What the offsets of a run's points may be, as roots of mean squares.
struct Residuals {
  double rms = 0;             ///< expected; 0: whatever the tolerance leaves
  double noise = 0;           ///< of the points as they are fitted
  double standard_error = 0;  ///< of the root of the mean square of so many errors, a part of it
  /// What the root of the mean square may be: so many standard errors above what is expected.
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
Residuals allowed_residuals(const std::vector<FitPoint>& points, bool closed, std::size_t n,
                            double noise, double tolerance, double smoothness);

}  // namespace keyline::fairing::detail
