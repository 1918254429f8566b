#pragma once

#include "keyline/lac/chain/chain.h"

namespace keyline::lac {

/// Bound of the distance between points at equal fractions of the lengths of two chains that leave
/// one place in one direction, and so of the largest distance from either to the other.
///
/// Method: the difference D of the two and its second derivative on stretches on which all four
/// curvatures are monotone: |D| is at most the larger of its values at the ends and width^2 / 8
/// times the bound of |D''|, which follows from the curvatures and tangent angles at the ends.
/// Stretches are halved until that is within 0.5 % of the largest |D| seen, seven times at most:
/// nothing is sampled and hoped for, and 1e-10 of the length is about the least that is told.
/// Rounding is covered by 1e-14 of the length. Infinite where a curvature is.
double departure_bound(const Chain& a, const Chain& b);

}  // namespace keyline::lac
