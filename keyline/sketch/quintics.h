#pragma once

#include <vector>

#include "keyline/core/point.h"
#include "keyline/curve/bezier.h"

namespace keyline::sketch {

/// Quadratic Béziers along concatenated line segments ([Sketch] section 5): the ends are midpoints
/// of segments, the middle handles the vertices between; the first and last reach to the ends.
/// They join with common tangents (G1). Two vertices give one straight piece.
std::vector<curve::Bezier2> quadratics(const std::vector<core::Point2>& vertices, bool closed);

/// The same curves, degree raised to 5.
std::vector<curve::Bezier2> elevated(const std::vector<curve::Bezier2>& pieces);

/// Signed curvature at the ends of a quintic, [Sketch] Eqs. 9 and 10.
double start_curvature(const curve::Bezier2& quintic);
double end_curvature(const curve::Bezier2& quintic);

/// Makes G1 chains of quintics curvature-continuous by Eqs. 9 and 10: at every joint (closed: also
/// from the last to the first) the third handle on either side moves along the normal until both
/// have the mean of the two curvatures. End points and end tangents stay.
void make_curvature_continuous(std::vector<curve::Bezier2>& quintics, bool closed);

}  // namespace keyline::sketch
