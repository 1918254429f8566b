#pragma once

#include "keyline/curve/concept.h"
#include "keyline/curve/jet.h"

namespace keyline::curve {

/// tangent_angle and unit_tangent of a curve that arrives: where the speed is zero, the direction
/// of travel for t growing up to here, as at the end of a Bezier whose last two control points
/// coincide.
double arriving_angle(const Jet2& jet);
core::Vector2 arriving_tangent(const Jet2& jet);

/// Direction of travel at a parameter of a curve, at its end that in which it arrives.
template <PlanarCurve C>
double travel_angle(const C& c, double t) {
  return t < 1 ? tangent_angle(jet(c, t)) : arriving_angle(jet(c, t));
}

}  // namespace keyline::curve
