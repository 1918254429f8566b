#pragma once

#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/piecewise_bezier.h"

namespace keyline::fit {

/// A curvature wanted at parameter t of a chain (every piece takes an equal share of [0, 1]).
struct CurvatureTarget {
  double t = 0;
  double curvature = 0;  ///< signed, positive left, in 1 / the curve's unit
  friend bool operator==(const CurvatureTarget&, const CurvatureTarget&) = default;
};

struct CurvatureDriveOptions {
  bool closed = false;          ///< the end stays in the start; implies hold_end
  bool hold_end = false;        ///< the end point stays; else it moves with the lengths
  bool hold_curvature = false;  ///< at both ends, where the curve goes on (open chains)
  bool keep_monotone = false;   ///< pieces certified monotone stay so
  double max_deviation = 0;     ///< largest distance from the curve given, a bound; 0: any
  int max_iterations = 100;
};

struct CurvatureDrive {
  curve::PiecewiseBezier chain;  ///< quintics; pieces with an inflection come back as two
  double before = 0;             ///< root mean square of curvature less target, at the targets
  double after = 0;
  double share = 1;  ///< of the way to the target that keep_monotone allowed, 0 … 1
  /// Bound of the distance between the curve and the one given, either way
  /// (curve::deviation_bound); what a free end moved along the curve does not count.
  double moved = 0;
  double end_moved = 0;  ///< distance of the end point from where it was
  int iterations = 0;
  bool converged = false;
  std::vector<CurvatureTarget> target;  ///< as used: t over the chain that came back
  std::vector<std::string> notes;
};

/// Modifies a chain of quintic Béziers so that its curvature follows a target, [Sketch] section 6.
///
/// The directions of all control edges stay, their lengths a_1 … a_5 per piece (positive) are
/// found by damped Gauss–Newton on Eq. 14 with the analytic Jacobian, over the whole chain at
/// once: pieces share their joints, and where a joint had one curvature on both sides it keeps one
/// (Eqs. 9 and 10 eliminate a length). An inflection cannot lie inside a piece of constant
/// directions, so pieces are split at inflections first. Where targets are few, curvatures
/// between them are interpolated (monotone cubics).
/// Five lengths cannot meet every target: `after` says what was reached. Nor does Eq. 14 say where
/// the curve lies: along nearly straight stretches any length will do. With max_deviation the
/// distance moved counts as well, with the least weight that keeps the curve within.
///
/// Fails: bad_input for pieces of a degree other than 1 to 5 or rational ones, pieces that do not
///        join, edges of no length, fewer than two targets, targets outside [0, 1] or past 1e100;
///        undrawable where the end is to be held on a chain whose free edges are all parallel.
/// Accuracy: without max_deviation, targets from a chain of the same directions are met to
/// rounding.
core::Result<CurvatureDrive> drive_curvature(const curve::PiecewiseBezier& chain,
                                             std::vector<CurvatureTarget> targets,
                                             const CurvatureDriveOptions& options = {});

}  // namespace keyline::fit
