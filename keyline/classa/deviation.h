#pragma once

#include <span>

#include "keyline/curve/bezier.h"

namespace keyline::classa {

/// A bound of the largest distance, either way, between a row of polynomial Béziers (each starting
/// where the last ended) and the polynomial Bézier q: the row is carried onto q by a piecewise
/// linear change of parameter through feet of its points, so that no part of either is left out,
/// and the differences are bounded by their Bernstein coefficients. Nothing is left to samples but
/// how sharp the bound is: parts are halved, eleven times at most, until each is below `wanted`.
/// Rigorous up to rounding.
double deviation_bound(std::span<const curve::Bezier2> row, const curve::Bezier2& q, double wanted);

/// The same of two polynomial Beziers in space, start compared with start and end with end.
double deviation_bound(const curve::Bezier3& c, const curve::Bezier3& q, double wanted);

}  // namespace keyline::classa
