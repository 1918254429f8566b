#pragma once

#include "keyline/core/interval.h"
#include "keyline/lac/hermite/hermite.h"

/// The drawable region: which triangles a slope can meet.
namespace keyline::lac {

/// Open interval of chord angles psi (from the start tangent, 0 < psi < theta) that a segment of
/// slope alpha turning by theta can have, over both end orders: [theta - psi*, psi*].
/// Closed form for 0 <= alpha <= 1: psi* = theta. Otherwise psi* is the chord angle of the curve
/// with an inflection (alpha < 0) or a cusp (alpha > 1) at an end, by quadrature to 2e-15; the
/// curve at the border itself can be drawn too. 0 < theta < pi, alpha finite (else InvalidInput).
core::Interval drawable_region(double alpha, double theta);

/// Both ways to make an undrawable request drawable.
struct NearestDrawable {
  double chord_angle = 0;  ///< a little inside the region, on the side of the one asked for
  double alpha = 0;        ///< the nearest slope whose region holds the chord angle asked for
};
/// 0 < psi < theta < 2 pi.
NearestDrawable nearest_drawable(double alpha, double theta, double psi);

}  // namespace keyline::lac
