#pragma once

#include "keyline/core/progress.h"
#include "keyline/fairing/dense_curve.h"

namespace keyline::fairing::detail {

struct BandOptions {
  double tolerance = 1e-4;  ///< no point farther off, in the points' unit
  int iterations = 150;
  double gap = 0.01;  ///< of the energy: how far from the least it may stop
  /// Gives up after so many steps in a row that take back less than a tenth of the width by which
  /// the band is still too wide; 0: never.
  int patience = 0;
  bool warm = false;  ///< the curve given follows the points already
  /// Root of the mean square of the offsets that the curve is to keep before the tolerance is
  /// looked at, by springs beside the energy; 0: none. Not where `spring` is told.
  double rms = 0;
  double spring = 0;  ///< weight of half the mean square of the offsets beside the energy
  core::Progress progress;
};

struct BandReport {
  bool converged = false;
  bool within = false;  ///< every point within the tolerance
  int iterations = 0;
  double energy = 0;      ///< L^3 * integral of (d curvature / ds)^2
  double max_offset = 0;  ///< largest distance of a point, spread included
  double rms = 0;         ///< root of the mean square of the offsets
  double spring = 0;      ///< weight of its square's half that was taken
};

/// The curve of least variation of curvature within the tolerance of the points, from the one
/// given: sequential quadratic programming with a primal-dual interior point, each step one sweep
/// over the cells. The band starts as wide as the first curve needs and is drawn in.
///
/// Source: the minimum variation curves of [Moreton 1992] within a band of tolerance;
///         docs/design/fairness.md.
BandReport least_variation(DenseCurve& curve, const std::vector<FitPoint>& points,
                           const BandOptions& options);

}  // namespace keyline::fairing::detail
