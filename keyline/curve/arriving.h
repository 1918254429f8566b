#pragma once

#include "keyline/curve/jet.h"

namespace keyline::curve {

/// tangent_angle and unit_tangent of a curve that arrives: where the speed is zero, the direction
/// of travel for t growing up to here, as at the end of a Bezier whose last two control points
/// coincide.
double arriving_angle(const Jet2& jet);
core::Vector2 arriving_tangent(const Jet2& jet);

}  // namespace keyline::curve
