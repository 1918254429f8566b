#pragma once

#include "keyline/curve/bezier.h"
#include "keyline/lac/segment/segment.h"

namespace keyline::lac {

/// Bound of the distance between a segment and a Bézier curve run the same way: of Fréchet's
/// distance, and so of the largest distance from either to the other.
///
/// Method: the segment is cut into stretches on which its Taylor series of degree 20 is within
/// 1e-14 of the length (remainder by Cauchy's estimate, taylor.h; next to a singular end the
/// tangent line, off by no more than length times turning). On each stretch the Bézier's parameter
/// is a polynomial through feet of normals, so that the difference is a polynomial of known
/// degree n, bounded by its values at N = 4n Chebyshev nodes divided by cos(n pi / 2N) = 0.92
/// ([Ehlich 1964]). Between the nodes nothing is left to luck; the bound is
/// 0 to 4 % above the distance under this change of parameter, of a rational curve some 20 %. The
/// worst stretch is halved, 64 times at most, where points compared are not the nearest to each
/// other or weights run far on it. Rounding is covered by 1e-14 of the length. Weights must be
/// positive. Infinite where the two have nothing to do with each other.
double deviation_bound(const Segment& segment, const curve::Bezier2& bezier);

}  // namespace keyline::lac
