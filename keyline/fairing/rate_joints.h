#pragma once

#include <vector>

#include "keyline/core/interval.h"
#include "keyline/core/progress.h"
#include "keyline/fairing/chain_fit.h"

namespace keyline::fairing::detail {

struct RateOptions {
  double tolerance = 0;  ///< of the points' offsets, in their unit
  core::Interval slopes{-3, 3};
  core::Progress progress;
};

struct RateReport {
  bool within = false;  ///< the points are, and the pieces meet
  int joints = 0;       ///< at which the rate could be one: curvature runs one way through them
  int missed = 0;       ///< at which it is not
};

/// Makes the rate at which curvature changes continuous at the joints of a G2 chain through which
/// curvature runs one way: G3 joints. Where curvature turns they cannot be: along a log-aesthetic
/// piece the rate never vanishes.
///
/// Unknown are the curvatures of the joints and the lengths and slopes of the pieces, in one solve
/// with the jumps of the rate's logarithm beside the variation of curvature and the points'
/// tolerance. Jumps count by their size, not its square, so that few stay; those that are gone are
/// then held at none, and the pieces beside the others parted, some times over. The chain with the
/// fewest is given. Points in order along the chain, lengths of order one.
///
/// Source: docs/design/fairness.md.
RateReport join_rates(FitChain& chain, const std::vector<FitPoint>& points,
                      const RateOptions& options);

}  // namespace keyline::fairing::detail
