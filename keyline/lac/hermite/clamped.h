#pragma once

#include <optional>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/core/pose.h"
#include "keyline/lac/chain/chain.h"
#include "keyline/lac/hermite/hermite.h"

/// G1 Hermite interpolation where the end curvatures differ by more than doubles can hold
/// (docs/design/g1-solver.md, "Beyond the doubles").
namespace keyline::lac {

/// A G1 solution of one piece, or of two where one piece's curvatures would leave the doubles.
struct G1Chain {
  Chain chain;            ///< from P0 to P2
  bool reversed = false;  ///< as in SegmentSolution, like the next three
  double lambda = 0;
  double turning = 0;
  double chord_angle = 0;
  bool clamped = false;  ///< two pieces: curvature stays constant from e^-100 (slope near 0) or
                         ///< e^100 (near 1) times that of the other end on
};

/// As solve_g1, but nothing drawable is refused. For a slope within about 0.06 of 0 (of 1), close
/// to the border of the drawable region, the ratio of the end curvatures leaves the doubles; all
/// of the turning (of the length) then lies within e^-87 next to one end, and the curve is told
/// from its clamped form neither in position (1e-30 of the chord) nor in direction (1e-30 rad).
/// The two pieces share the curvature at their joint.
core::Result<G1Chain> solve_g1_chain(core::Point2 p0, core::Point2 p1, core::Point2 p2,
                                     double alpha);
/// For a chord of length 1 along x.
core::Result<G1Chain> solve_g1_chain(const HandleAngles& angles, double alpha);
/// As solve_g1_directions.
core::Result<G1Chain> solve_g1_directions_chain(const core::Pose2& start, const core::Pose2& end,
                                                double alpha);

}  // namespace keyline::lac
