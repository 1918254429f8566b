#pragma once

#include <vector>

#include "keyline/analysis/profile.h"

namespace keyline::analysis {

/// One point of the logarithmic curvature graph; natural logarithms, lengths in the curve's unit.
struct LcgPoint {
  double log_radius;  ///< log rho
  double log_rate;    ///< log(rho ds/drho), which is log|kappa / (dkappa/ds)|
};

/// Logarithmic curvature graph with the straight line of least squares through its points.
///
/// slope is the line's alpha, intercept its height at log rho = 0, variance the mean square of
/// the vertical residuals. For a log-aesthetic curve the slope is its alpha and the variance 0:
/// clothoid -1, Nielsen's spiral 0, logarithmic spiral 1, involute of a circle 2.
/// defined is false, and the numbers 0, where there is no line: fewer than three points, or a
/// radius that does not change (straight line, circular arc).
struct Lcg {
  bool defined = false;
  double slope = 0;
  double intercept = 0;
  double variance = 0;
  std::vector<LcgPoint> points;
};

/// Graph of a profile, computed from curvature and its rate without numerical differentiation.
///
/// Left out are samples where the graph runs to infinity: |kappa| or |dkappa/ds| below
/// cutoff times its largest value along the profile. Samples count alike, so space them evenly in
/// arc length. Turning, moving, scaling and reversing a curve leave slope and variance alone.
/// Source: [QLAC] section 2; in its notation the graph of log(rho ds/drho) over log rho.
Lcg logarithmic_curvature_graph(const CurvatureProfile& profile, double cutoff = 1e-9);

/// Graph of a whole curve at n samples of equal arc length.
template <curve::PlanarCurve C>
Lcg logarithmic_curvature_graph(const C& c, int n = 501) {
  return logarithmic_curvature_graph(curvature_profile(c, n));
}

}  // namespace keyline::analysis
