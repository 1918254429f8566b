#pragma once

#include <vector>

#include "keyline/document/planar_curve.h"

namespace keyline::document {

constexpr double kCorner = 1e-7;  // radians: a turn of the tangent at a joint above this

/// The members of a path cut wherever their direction jumps, or where they stop: the edges of a
/// polyline, the Bézier curves of a spline that has such a place. Without those that have no
/// length.
std::vector<PlanarCurve> smooth_members(const Path& path);

}  // namespace keyline::document
