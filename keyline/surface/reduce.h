#pragma once

#include "keyline/surface/bezier_surface.h"

namespace keyline::surface {

/// The polynomial patch of these degrees (at least 1) nearest to a polynomial patch at equal
/// parameters: least squares over 33 x 33 places, corners kept. A patch of these degrees or lower
/// comes back as itself, its degree raised.
BezierSurface reduced_degree(const BezierSurface& s, int degree_u, int degree_v);

}  // namespace keyline::surface
