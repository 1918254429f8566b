#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "keyline/core/interval.h"
#include "keyline/core/progress.h"
#include "keyline/fairing/chain_fit.h"

namespace keyline::fairing::detail {

/// What a chain with more joints of one rate would lose.
enum class RateLoss {
  slopes,     ///< pieces of these slopes do not come to one rate
  tolerance,  ///< a point would leave it
  variation,  ///< would grow to more than twice the G2 chain's
  waves,      ///< there would be more
  bounds      ///< would be passed
};

struct RateOptions {
  double tolerance = 0;  ///< of the points' offsets, in their unit
  core::Interval slopes{-3, 3};
  /// What else a chain that keeps the tolerance would lose; nothing: it is taken.
  std::function<std::optional<RateLoss>(const FitChain&)> loses;
  core::Progress progress;
};

struct RateReport {
  bool within = false;  ///< the points are, the pieces meet, and nothing is lost
  int joints = 0;       ///< at which the rate could be one: curvature runs one way through them
  int missed = 0;       ///< at which it is not
  struct Stay {
    int piece = 0;  ///< that begins at the joint
    RateLoss loss = RateLoss::slopes;
  };
  std::vector<Stay> stay;  ///< the joints missed, and what held them there
};

/// Makes the rate at which curvature changes continuous at the joints of a G2 chain through which
/// curvature runs one way: G3 joints. Where curvature turns they cannot be: along a log-aesthetic
/// piece the rate never vanishes.
///
/// Unknown are the curvatures of the joints and the lengths and slopes of the pieces, in one solve
/// with the jumps of the rate's logarithm beside the variation of curvature and the points'
/// tolerance. Jumps count by their size, not its square, so that few stay; those that are gone are
/// then held at none, and the pieces beside the others parted, some times over. The chain with the
/// fewest is given. Where nearly all cannot be held, those are that can: from the G2 chain on, all
/// at once or half of them, and half of that, to single joints, each as long as nothing is lost.
/// Points in order along the chain, lengths of order one.
///
/// Source: docs/design/fairness.md.
RateReport join_rates(FitChain& chain, const std::vector<FitPoint>& points,
                      const RateOptions& options);

}  // namespace keyline::fairing::detail
