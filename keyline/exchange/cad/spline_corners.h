#pragma once

#include <vector>

#include "keyline/document/planar_curve.h"

namespace keyline::exchange::detail {

/// A spline parted where it has a corner: a knot of multiplicity `degree` at which its direction
/// turns by more than 1e-6 rad. Straight parts of one span become lines,
/// splines of degree 1 without weights polylines.
std::vector<document::PlanarCurve> parted_at_corners(const curve::BSpline2& spline);

}  // namespace keyline::exchange::detail
