#pragma once

#include <cmath>

#include "keyline/fairing/least_variation.h"

/// Straight lines and circular arcs in a calm curve.
namespace keyline::fairing::detail {

struct FlatOptions {
  BandOptions band;            ///< warm
  double most_rms = HUGE_VAL;  ///< of the offsets
  double noise = 0;            ///< of the points, above 0
  double worth = 1.25;         ///< so many times the energy is the most that they may cost
};

/// Energy below which nothing is to be seen: of curvature that changes so little that a curve of
/// that length departs from an arc by a tenth of the tolerance.
double unseen_energy(double length, double tolerance);

/// Where points stand on a line (see straight_stretches) the free curve becomes one, as far as it
/// stays within the tolerance, turns no more often, shows no more waves and costs no more than
/// that; `band` tells of what was solved last.
void lay_lines(DenseCurve& curve, BandReport& band, const std::vector<FitPoint>& points,
               const FlatOptions& options);

/// Pieces with next to no variation that depart from arcs by less than the points can tell become
/// arcs, all of them or the half that has least, as lines do.
void make_arcs(DenseCurve& curve, BandReport& band, const std::vector<FitPoint>& points,
               const FlatOptions& options);

}  // namespace keyline::fairing::detail
