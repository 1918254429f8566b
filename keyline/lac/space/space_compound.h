#pragma once

#include <array>

#include "keyline/core/error.h"
#include "keyline/lac/space/space_hermite.h"

namespace keyline::lac {

/// Two slopes of curvature and two of torsion; the first of each for the piece at the start.
struct SpaceRhythm {
  std::array<double, 2> alpha{-1, 1};
  std::array<double, 2> beta{-1, -1};
  double omega = 0;           ///< of the first piece, as for solve_g1_space
  double length_share = 0.5;  ///< of the whole arc length in the first piece, in (0, 1)
};

/// Compound rhythm in space ([Compound] 6): G1 Hermite data met by two pieces with curvature,
/// torsion and the rates of both continuous at the joint. lambda, nu and omega are those of the
/// first piece, conventions and handedness as solve_g1_space; data in one plane give the plane
/// curve of both slopes, without torsion and without regard to omega, through an inflection where
/// one of the slopes is below 0, and of several the one that turns least (compound_plane.h).
///
/// In space led by Newton's method from a curve of one slope (either piece's, or the mean of both)
/// while the slopes part; where that leads nowhere, from places all over the family. Of those found
/// together the one that turns least, none by more than 3 pi.
/// Accuracy: 1e-12 of the chord, 1e-12 rad. 5 to 30 ms; where the family is searched 0.1 to 0.8 s.
/// Fails: bad_input as solve_g1_space and for a share outside (0, 1); not_converged where no curve
/// was found; in a plane undrawable where the data need an inflection that neither slope has, or
/// neither has one and no rate at the joint serves.
core::Result<SpaceSolution> solve_compound_space(const SpaceHermite& data,
                                                 const SpaceRhythm& rhythm);

}  // namespace keyline::lac
