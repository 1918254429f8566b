#pragma once

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/lac/space/space.h"

namespace keyline::lac {

/// G1 Hermite data in space; tangents of any length but zero.
struct SpaceHermite {
  core::Point3 start;
  core::Point3 end;
  core::Vector3 start_tangent{1, 0, 0};
  core::Vector3 end_tangent{1, 0, 0};
};

struct SpaceSolution {
  SpaceChain chain;  ///< one piece, from start to end
  /// drho/ds at the start, where the radius of curvature is taken for 1; negative: the radius
  /// falls; -infinity where the start has no curvature though the rest has: the radius falls from
  /// infinity.
  double lambda = 0;
  double nu = 0;      ///< torsion at the start in the same unit
  double length = 0;  ///< arc length in the same unit (0: no curvature at the start)
  bool planar = false;
  int iterations = 0;
};

/// The log-aesthetic space curve with slopes alpha (curvature) and beta (torsion) through two
/// points with given tangents; omega, the standard form's rate of torsion, is given in units of the
/// radius of curvature at the start, which is the reference point. Solved for lambda, nu and length
/// (three shape invariants, three unknowns): Newton's method led from a plane curve or a circular
/// arc to the data (docs/design/space-hermite.md).
///
/// omega counts for data whose end tangent is turned counter-clockwise about the chord out of the
/// plane of the start tangent (as a curve of positive torsion turns it); data turned the other way
/// get the mirror image of what the mirrored data get, nu and torsion with the other sign. So for
/// a slope beta below 0, whose torsion may pass through zero, |torsion| runs the same way in both.
///
/// Where no way leads from a known curve to the data the whole family is searched (up to 1 s).
/// Where ends and tangents lie in one plane (within 1e-12) the answer is the plane curve of
/// solve_g1_directions, whatever beta and omega: a plane curve has no torsion to have a slope.
/// Accuracy: ends to rounding, tangents 1e-12 rad. One to three milliseconds.
/// Fails: bad_input; not_converged with, in the hint, how far towards the data a curve was found.
core::Result<SpaceSolution> solve_g1_space(const SpaceHermite& data, double alpha, double beta,
                                           double omega);

namespace detail {

/// The same by the ways from known curves alone, without the search of the whole family: where
/// many answers are tried as starts of something else.
core::Result<SpaceSolution> solve_g1_space_by_ways(const SpaceHermite& data, double alpha,
                                                   double beta, double omega);

}  // namespace detail
}  // namespace keyline::lac
