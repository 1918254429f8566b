#pragma once

#include <vector>

#include "keyline/fairing/chain_search.h"

namespace keyline::fairing::detail {

/// Largest distance, part of the length, of a point that counts as reproduced to rounding: 2e-7, or
/// six times the noise.
double exactness(const Acceptance& accept);

/// Whether the points may be those of a chain that one draws exactly, of few pieces: most stretches
/// of so short a part of the length that they lie inside one piece are followed by a single piece
/// to rounding.
bool may_be_exact(const std::vector<FitPoint>& points, bool closed, double exact);

/// Exact data deserve the chain that reproduces them, where it is about as short as the one the
/// tolerance asks for: that one itself once converged, one for a tighter tolerance, or the shortest
/// found that reproduces the points. `best` comes from a search with these options; true where it
/// was replaced by a chain that reproduces the points.
bool find_exact(ChainSearchResult& best, const std::vector<FitPoint>& points, bool closed,
                ChainSearchOptions search);

}  // namespace keyline::fairing::detail
