#pragma once

#include <vector>

#include "keyline/fairing/chain_search.h"

namespace keyline::fairing::detail {

/// Largest distance, part of the length, of a point that counts as reproduced to rounding: 2e-7, or
/// six times the noise.
double exactness(const Acceptance& accept);

/// Exact data deserve the chain that reproduces them, where it is about as short as the one the
/// tolerance asks for: that one itself once converged, one for a tighter tolerance, or the shortest
/// found that reproduces the points. `best` comes from a search with these options; true where it
/// was replaced by a chain that reproduces the points.
bool find_exact(ChainSearchResult& best, const std::vector<FitPoint>& points, bool closed,
                ChainSearchOptions search);

}  // namespace keyline::fairing::detail
