#pragma once

#include "keyline/analysis/profile.h"

namespace keyline::analysis {

/// Measures of fairness; lengths in the curve's unit, angles in radians.
///
/// Integrals by an eight-point Gauss rule between breakpoints; at a cusp or corner they hold for
/// the smooth parts. Range and counts come from split_monotone without noise.
struct Fairness {
  double length = 0;
  double total_turning = 0;     ///< integral of kappa ds: signed turning, corners left out
  double absolute_turning = 0;  ///< integral of |kappa| ds
  double bending_energy = 0;    ///< integral of kappa^2 ds, 1/length
  double variation_energy = 0;  ///< integral of (dkappa/ds)^2 ds, 1/length^3 (minimum variation)
  double curvature_min = 0;
  double curvature_max = 0;
  int inflections = 0;
  int extrema = 0;  ///< of signed curvature, ends left out
  int corners = 0;
};

Fairness fairness(const CurveView& curve);

template <curve::PlanarCurve C>
Fairness fairness(const C& c) {
  return fairness(view(c));
}

}  // namespace keyline::analysis
