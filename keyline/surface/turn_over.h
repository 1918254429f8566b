#pragma once

#include "keyline/surface/bezier_surface.h"

namespace keyline::surface {

/// Whether the normal of `after` points away from that of `before` at one of 17 by 17 places, the
/// same parameters on both: the patch folds over itself there, which neither its boundary nor how
/// far it moved need tell. Places where either has no normal do not count.
bool turns_over(const BezierSurface& before, const BezierSurface& after);

}  // namespace keyline::surface
