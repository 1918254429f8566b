#pragma once

#include "keyline/surface/surface.h"

namespace keyline::surface {

/// A bound of the largest distance, either way, between two polynomial Bézier patches.
///
/// Each is cut into cells whose corners know points close to their nearest on the other; in a cell
/// the difference of the two, the other run at the bilinear image of the corners, is at most that
/// at the corners and h^2 / 8 times its second derivatives, which the control nets bound. The cell
/// of the largest bound is halved until that is `wanted` or within 0.5 % of the farthest corner, or
/// the cell a 128th of a side. Rigorous up to rounding, as sharp as the nearest points are. Throws
/// InvalidInput for a rational patch.
double departure_bound(const BezierSurface& a, const BezierSurface& b, double wanted = 0);

}  // namespace keyline::surface
