#pragma once

#include "keyline/core/progress.h"
#include "keyline/fairing/rate_model.h"

namespace keyline::fairing::detail {

struct RateSolution {
  FitChain chain;
  double max_offset = 0;  ///< in tolerances
  double gaps = 0;        ///< see RateModel
  double variation = 0;
  std::vector<double> jump;    ///< of the rate's logarithm, by joint
  std::vector<double> strain;  ///< of tied joints: what their tie costs
  std::vector<double> offset;  ///< of the points, in tolerances
};

/// Sequential quadratic programming: the least squares under the equations of the gaps, the seam
/// and the tied rates, slopes and curvatures' senses kept by a primal-dual barrier.
RateSolution solve_rates(FitChain chain, const RateProblem& problem, int iterations,
                         const core::Progress& progress);

/// Brings pieces together and tied rates to one to the last digits, moved as little as that takes.
FitChain close_rates(FitChain chain, const RateProblem& problem);

}  // namespace keyline::fairing::detail
