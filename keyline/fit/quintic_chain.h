#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/curve/bezier.h"

namespace keyline::fit {

struct QuinticChainOptions {
  double tolerance = 0.5;  ///< largest distance of a point from the curve, in the points' unit
  int max_pieces = 48;
  bool calm = false;  ///< the least variation of curvature within the tolerance; else least squares
  bool free_start =
      false;              ///< an open chain's start lies anywhere within the tolerance of the first
  bool free_end = false;  ///< point, its end of the last; else exactly there
  /// Only every such point is looked at, in the mean of its neighbours, and an open line's ends,
  /// where that comes within the tolerance of all: points that were smoothed say the same as they.
  std::size_t every = 1;
};

struct QuinticChain {
  std::vector<curve::Bezier2> pieces;  ///< quintics, G2 at every joint
  double max_deviation = 0;            ///< of the points
  double rms_deviation = 0;
  bool within_tolerance = false;  ///< false: max_pieces were not enough; the best is returned
};

/// As few quintic Béziers as it takes to follow ordered points within a tolerance, joined with
/// equal tangent and curvature.
///
/// Every joint has a place, a direction and a curvature, every piece four lengths along its end
/// tangents (the third handles stand off by Eqs. 9 and 10 of [Sketch], which makes joints G2
/// whatever the values): all are found together by Gauss–Newton on the distances of the points
/// along the curve's normals, feet of the points moving along. Pieces are added one by one, up to
/// four with joints laid so that each has about its share of length and turning; from there those
/// pieces are halved that deviate most. Where the chain is to be calm, a weight on L³ ∫ (dκ/ds)² ds
/// ([Moreton 1992]) is raised then as far as the tolerance allows, points at its rim pulling
/// harder, and up to four pieces are taken as long as one more leaves a quarter of it or less. No
/// piece slows down to a tenth of its mean speed: there the curvature would have a needle.
///
/// points: at least two, no two neighbours equal (InvalidInput otherwise); closed: the first is not
///         repeated. An open chain starts and ends exactly in the first and last point.
QuinticChain fit_quintic_chain(const std::vector<core::Point2>& points, bool closed,
                               const QuinticChainOptions& options = {});

}  // namespace keyline::fit
