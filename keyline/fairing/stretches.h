#pragma once

#include <optional>
#include <vector>

#include "keyline/fairing/chain_fit.h"

/// What single pieces tell of points before any chain is looked for.
namespace keyline::fairing::detail {

/// Whether the points may be those of a chain that one draws exactly, of few pieces: most stretches
/// of so short a part of the length that they lie inside one piece are followed by a single piece
/// to rounding, and where two such pieces meet their curvatures do. Arcs that meet with a step of
/// curvature are no such chain; what bridges the step is a piece too short for the points to tell.
bool may_be_exact(const std::vector<FitPoint>& points, bool closed, double exact);

/// The single piece through all points, where there is one to rounding: of a closed run an arc, if
/// anything, whose ends the fit of the chain makes one.
std::optional<FitChain> one_exact_piece(std::vector<FitPoint> points, bool closed, double exact);

}  // namespace keyline::fairing::detail
