#pragma once

#include "keyline/fairing/least_variation.h"

namespace keyline::fairing::detail {

/// Nodes of the curve where curvature turns, alternately highest and lowest, every swing between
/// neighbours (and to the ends of an open curve) at least `least`.
std::vector<int> extrema_of(const DenseCurve& curve, double least);

struct CalmOptions {
  BandOptions band;
  double worth = 1.5;  ///< a wave stays where the energy without it is more than so many times
};

struct CalmReport {
  BandReport band;
  double least_energy = 0;  ///< with every wave that lowers it
  int removed = 0;          ///< waves that the points do not ask for
};

/// Takes waves of curvature out of the curve of least variation, lowest first, each by solving
/// again without it, as long as the points stay within the tolerance and the energy does not rise
/// by `worth`.
CalmReport calm(DenseCurve& curve, const std::vector<FitPoint>& points, const CalmOptions& options);

}  // namespace keyline::fairing::detail
