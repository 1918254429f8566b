#pragma once

#include <optional>
#include <vector>

#include "keyline/fairing/chain_fit.h"

namespace keyline::fairing::detail {

/// Of the length: what a point's own digits put it off a line or an arc.
inline constexpr double kAtSight = 1e-12;

/// The one line through points that lie on it in order, none farther off than rounding (kAtSight):
/// nothing shorter or nearer is to be found by a search. Empty for any other points.
/// Precondition: total length about 1.
std::optional<FitChain> straight_chain(const std::vector<FitPoint>& points);

/// The one arc through points in order, none farther off than `within` (their spread included): no
/// curve varies less, so where there is one it is the calmest. It turns by less than half a turn
/// from point to point, or by less than a whole turn in all; three points always lie on one. Where
/// points are farther off than rounding the arc of least squares is taken. Empty for points on a
/// line.
std::optional<FitChain> arc_chain(const std::vector<FitPoint>& points, double within = kAtSight);

}  // namespace keyline::fairing::detail
