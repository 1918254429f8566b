#pragma once

#include "keyline/core/error.h"
#include "keyline/core/pose.h"
#include "keyline/lac/chain/chain.h"

/// G2 Hermite interpolation by two or three log-aesthetic pieces of one slope
/// (docs/design/g2-chains.md).
namespace keyline::lac {

/// End of a curve: place, direction of travel and signed curvature there.
struct CurvatureElement {
  core::Pose2 pose;
  double curvature = 0;
  friend bool operator==(const CurvatureElement&, const CurvatureElement&) = default;
};

struct G2Solution {
  Chain chain;                  ///< one, two or three pieces, from start to end
  double absolute_turning = 0;  ///< left and right turning together
  double bending_energy = 0;    ///< integral of the squared curvature, in 1/length
  double residual = 0;          ///< of the end's position over the chord, or direction if larger
  int starts = 0;               ///< starting points of Newton's method that were tried
};

/// A chain of slope alpha from start to end with the given directions and curvatures at both ends,
/// curvature continuous inside. The tangent angle runs without a jump between the end directions,
/// both measured from the chord in (-pi, pi].
///
/// One piece where one fits (to 1e-12), else two where some two pieces do, else three, the outer
/// ones equally long where such a chain is found, else short against their end radii. Of several
/// solutions with as many pieces the one of least absolute turning, and of those (within 1e-9) of
/// least bending energy. The same chain on the way back and in a mirror. Where one segment joins
/// the poses without regard to curvature it is the measure of wildness: a solution with a piece
/// that turns by more than 3 pi / 2 and 1.25 times that segment's turning, or longer than 12 chords
/// and twice the segment, does not count.
///
/// alpha < 0: inflections are allowed. alpha >= 0: curvature keeps one sign, so both curvatures
/// must be of the sign of the turning and not zero.
/// Accuracy: end position 1e-12 of the chord, direction 1e-12 rad; end curvatures are exact.
/// Fails: bad_input; undrawable where there is none, or not_converged where none was found, with
/// the reason and, in the hint, what would serve: a slope below 0, or the end curvatures of the one
/// segment between the poses.
core::Result<G2Solution> solve_g2(const CurvatureElement& start, const CurvatureElement& end,
                                  double alpha);

}  // namespace keyline::lac
