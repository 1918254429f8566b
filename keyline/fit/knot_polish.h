#pragma once

#include <span>
#include <vector>

#include "keyline/fit/knot_search.h"

namespace keyline::fit::detail {

/// Knots and their criterion.
struct ScoredKnots {
  std::vector<double> knots;
  double bic = 0;
};

/// Improves knots by local search until nothing helps, `rounds` improvements were made or a stop
/// is requested: continuous optimisation of the positions (Levenberg-Marquardt on the residuals,
/// coefficients eliminated), neighbours merged into multiple knots and multiple knots split,
/// single knots removed, inserted and moved elsewhere; `in_pairs`: where nothing of that helps, two
/// inserted at once (not yet worth its time for large data). Never worse
/// than the start. Works with as many threads as there are solvers; the result does not depend on
/// their number.
ScoredKnots polish_knots(std::span<SplineSolver> solvers, const BayesCriterion& criterion,
                         const std::vector<double>& knots, int rounds,
                         const core::Progress& progress, bool in_pairs = false);

/// Knots with no two data between them made one, up to the multiplicity of a kink, while the
/// criterion rises by no more than `loss` in all: between knots a millionth apart a curve that
/// follows the data has needles of curvature of a million.
ScoredKnots united_knots(SplineSolver& solver, const BayesCriterion& criterion,
                         const ScoredKnots& found, double loss);

/// Whether a polish of such data is a matter of milliseconds, and tries harder.
bool is_small(const SplineSolver& solver);

/// Knots by refinement where residuals are large, then removal of those of little use: quick,
/// deterministic, a start for the genetic search. Thorough: also from knots too many to pay.
ScoredKnots refined_knots(SplineSolver& solver, const BayesCriterion& criterion, bool thorough);

}  // namespace keyline::fit::detail
