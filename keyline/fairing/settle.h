#pragma once

#include <vector>

#include "keyline/core/similarity.h"
#include "keyline/fairing/chain_search.h"
#include "keyline/lac/chain/chain.h"

/// From a chain that the search accepted to the one that is given out.
namespace keyline::fairing::detail {

/// Pieces that are straight lines or circular arcs as far as the points can tell become exactly
/// that. Returns how many.
int straighten(FitChain& chain, const std::vector<FitPoint>& points, const Acceptance& accept);

/// Arcs and lines that a solve knew as such get one curvature from end to end, to the last digit.
void flatten(FitChain& chain);

/// Least squares to the last digits; gaps between pieces close. Where the points do not pass then,
/// those far off are given more weight. True where they pass; else the chain nearest to it.
///
/// Slopes that the points hardly tell (of pieces nearly straight or circular) are drawn to -1, each
/// unit away counting as much as an offset of a third of the noise (or of a twentieth of the
/// tolerance); not where `exact`, nor where the points do not pass then.
bool polish(FitChain& chain, std::vector<FitPoint>& points, const Acceptance& accept, bool exact);

/// Sum of what the pieces turn, each taken as positive, radians.
double turned(const FitChain& chain);

/// One forward chain, G2 at its joints by construction, in the frame `to_canonical` maps from,
/// run the other way where `reversed`; closed chains and held ends meet their targets to rounding.
lac::Chain lay_out(const FitChain& chain, const core::Similarity2& to_canonical, bool reversed);

}  // namespace keyline::fairing::detail
