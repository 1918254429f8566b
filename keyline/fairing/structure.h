#pragma once

#include <vector>

#include "keyline/fairing/chain_search.h"

/// Where the noise limits: which joints a chain should have.
namespace keyline::fairing::detail {

/// Bayesian information criterion of a chain under normal errors of known size: the weighted sum
/// of squared offsets in units of the noise, and ln N for each of a piece's three numbers. Smaller
/// is better. Precondition: noise > 0.
double structure_score(const FitChain& chain, const std::vector<FitPoint>& points, double noise);

/// Changes the joints of an accepted chain while the score falls: one joint more in the middle or
/// near the ends of a piece, one joint less, each followed by least squares over the whole chain.
/// What `accept` refuses is not taken, nor a joint more that gains less than chance explains.
/// False where plain least squares does not keep the chain itself: then it is not changed.
bool improve_structure(FitChain& chain, const std::vector<FitPoint>& points,
                       const ChainSearchOptions& options);

}  // namespace keyline::fairing::detail
