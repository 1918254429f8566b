#pragma once

#include <optional>
#include <vector>

#include "keyline/fairing/chain_fit.h"

namespace keyline::fairing::detail {

/// The one line through points that lie on it in order, none farther off than rounding (1e-12):
/// nothing shorter or nearer is to be found by a search. Empty for any other points.
/// Precondition: total length about 1.
std::optional<FitChain> straight_chain(const std::vector<FitPoint>& points);

/// The same for one arc that turns by less than half a turn from point to point: any three points
/// in order lie on one, which is the calmest curve through them. Empty for points on a line.
std::optional<FitChain> arc_chain(const std::vector<FitPoint>& points);

}  // namespace keyline::fairing::detail
