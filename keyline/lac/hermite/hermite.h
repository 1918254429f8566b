#pragma once

#include <span>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/core/pose.h"
#include "keyline/lac/segment/segment.h"

/// G1 Hermite interpolation by one log-aesthetic segment ([QLAC] §2, [Compound] §2).
/// How it works and why it cannot run away: docs/design/g1-solver.md.
namespace keyline::lac {

/// Three handles P0, P1, P2 as angles: all that decides the shape.
struct HandleAngles {
  double turning = 0;      ///< theta, from P1-P0 to P2-P1, signed, in (-pi, pi]
  double chord_angle = 0;  ///< psi, from P1-P0 to P2-P0, of the same sign
  double chord = 0;        ///< |P2 - P0|
  double direction = 0;    ///< of P1-P0
};

/// Relative accuracy is that of the coordinates' differences; scales from 1e-150 to 1e150.
/// Fails (bad_input) where a coordinate is not finite or P0 and P2 coincide. Where P1 coincides
/// with P0 or P2 or lies on the chord, both angles are 0: a straight line.
core::Result<HandleAngles> handle_angles(core::Point2 p0, core::Point2 p1, core::Point2 p2);

/// A log-aesthetic segment through given ends with given tangents.
struct SegmentSolution {
  Segment segment;        ///< runs from P0 to P2
  bool reversed = false;  ///< the radius of curvature falls from P0 to P2: solved with ends swapped
  double lambda = 0;   ///< of the standard form: for alpha <= 1 the reference point is the end of
                       ///< smaller radius, for alpha > 1 that of larger; 0 for a circle
  double turning = 0;  ///< theta, signed
  double chord_angle = 0;  ///< psi at P0, signed
  int iterations = 0;
};

/// The segment of slope alpha from P0 to P2 with tangents P1-P0 and P2-P1; there is at most one.
///
/// Ends: position within 2e-15 of the chord, direction within 2e-15, arc length and curvatures to
/// rounding times the condition of the problem (the curvature at the end of larger radius is badly
/// conditioned close to the border of the drawable region).
/// Fails: bad_input (not finite, P0 = P2), undrawable (the chord angle is outside the drawable
/// region, see region.h; the hint names the nearest chord angle and the nearest alpha that serve),
/// undrawable as well where the ratio of the curvatures would leave the range of doubles (alpha
/// within 0.06 of 0 or 1, close to the region's border; solve_g1_chain, clamped.h, serves there).
core::Result<SegmentSolution> solve_g1(core::Point2 p0, core::Point2 p1, core::Point2 p2,
                                       double alpha);

/// The same for a chord of length 1 along x, given by turning and chord angle.
core::Result<SegmentSolution> solve_g1(const HandleAngles& angles, double alpha);

/// One of many problems for the batch entry point, and its answer.
struct G1Problem {
  core::Point2 p0, p1, p2;
  double alpha = -1;
};
struct G1Outcome {
  Segment segment;
  double lambda = 0;
  bool drawn = false;  ///< else solve_g1 of the same handles tells why not
  bool reversed = false;
};

/// solve_g1 for many problems, several at a time in vector lanes: the same curves within 1e-12 (in
/// curvature, as far as the problem is well conditioned), no allocation where all can be drawn.
/// The spans have one size (else InvalidInput).
void solve_g1(std::span<const G1Problem> problems, std::span<G1Outcome> outcomes);

/// The segment of slope alpha between two poses, its tangent angles running without a jump between
/// the end directions, both measured from the chord in (-pi, pi]: C-shaped where they lie on
/// different sides of the chord, else S-shaped, which needs an inflection and so alpha < 0. For
/// alpha < 0 a C-shaped request outside the drawable region is met with an inflection as well.
/// Of several curves that fit, the one nearest to a circular arc, reached without a jump.
///
/// Accuracy: 1e-14 of the chord, 1e-14 rad. Slower than three handles where it inflects (2 to 6
/// microseconds).
/// Fails: bad_input, and undrawable with the nearest slope that serves in the hint; undrawable as
/// well where the end curvatures would leave the range of doubles (slopes within 0.06 of 0 or 1;
/// solve_g1_directions_chain serves there).
core::Result<SegmentSolution> solve_g1_directions(const core::Pose2& start, const core::Pose2& end,
                                                  double alpha);

}  // namespace keyline::lac
