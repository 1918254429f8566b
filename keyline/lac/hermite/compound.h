#pragma once

#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/core/point.h"
#include "keyline/lac/chain/chain.h"
#include "keyline/lac/hermite/hermite.h"

/// Compound-rhythm log-aesthetic curves: two pieces whose logarithmic curvature graphs meet, so
/// that curvature and its rate agree at the joint: G3 ([Compound] §3-4).
namespace keyline::lac {

/// alpha0 and turning_share belong to the piece at the end of smaller radius of curvature.
struct CompoundRhythm {
  double alpha0 = -1;
  double alpha1 = 1;
  double turning_share = 0.5;  ///< r_theta: share of the whole turning in the first, in (0, 1)
};

struct CompoundSolution {
  Chain chain;                  ///< two pieces, from P0 to P2; up to six where clamped
  std::size_t joint_piece = 1;  ///< the first piece after the joint of the two slopes
  bool reversed = false;        ///< the piece of alpha0 comes last: the radius falls from P0 to P2
  double lambda0 = 0;  ///< of the standard form: reference point is the start for alpha0 <= 1, the
  double lambda1 = 0;  ///< joint for alpha0 > 1 ([Compound] Fig. 5); at most the largest double
  /// Curvature leaves e^-250 … e^250 over the chord: it stays constant from e^-100 and e^100 on,
  /// and the curve is told from the exact one by less than 1e-40 of the chord (see G1Chain).
  bool clamped = false;
  core::Point2 joint;
  double turning = 0;      ///< theta, signed
  double chord_angle = 0;  ///< psi at P0, signed
  int iterations = 0;
};

/// The compound-rhythm curve from P0 to P2 with tangents P1-P0 and P2-P1; at most one.
/// Accuracy, failures and straight lines as solve_g1; turning_share outside (0, 1) is bad_input.
/// Inside the drawable region nothing is refused.
core::Result<CompoundSolution> solve_compound(core::Point2 p0, core::Point2 p1, core::Point2 p2,
                                              const CompoundRhythm& rhythm);

/// The same for a chord of length 1 along x, given by turning and chord angle.
core::Result<CompoundSolution> solve_compound(const HandleAngles& angles,
                                              const CompoundRhythm& rhythm);

/// Open interval of the chord angles that can be met turning by theta, 0 < theta < pi; over both
/// end orders. Closed form: [0, theta] where the flatter piece has 0 <= alpha1 < 1 and runs out
/// before the sharper one (or alpha1 = 1, alpha0 <= 1). InvalidInput for a bad rhythm or theta.
core::Interval drawable_region(const CompoundRhythm& rhythm, double theta);
/// Whether the curve at the region's border exists itself (it ends in an inflection or a cusp).
bool border_is_drawn(const CompoundRhythm& rhythm, double theta);

}  // namespace keyline::lac
