#pragma once

#include "keyline/curve/piecewise_bezier.h"

namespace keyline::curve {

/// What of two chains is compared.
enum class ChainEnds {
  matched,  ///< start with start, end with end
  trimmed,  ///< what one reaches beyond the normal at the other's end is left out
};

/// A bound of the largest distance, either way, between two chains of polynomial Béziers run the
/// same way: one is carried onto the other by a piecewise linear change of parameter through feet
/// of its points and of both chains' joints, so that no part of either is left out, and the
/// differences are bounded by their Bernstein coefficients. Where that is not below `wanted`, as
/// next to corners, either is carried to where the other is nearest, each by itself. Nothing is
/// left to samples but how sharp the bound is: parts are halved, eleven times at most or the worst
/// 400, until each is below `wanted` or the whole within a hundredth of the distance. Rigorous up
/// to rounding. Throws InvalidInput where a chain is empty or a piece rational.
double deviation_bound(const PiecewiseBezier& a, const PiecewiseBezier& b, double wanted,
                       ChainEnds ends = ChainEnds::matched);

}  // namespace keyline::curve
