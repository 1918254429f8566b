#pragma once

#include <variant>

#include "keyline/surface/bezier_surface.h"
#include "keyline/surface/bspline_surface.h"

namespace keyline::surface {

/// Any surface of the library behind one type; u, v in [0, 1].
using Surface = std::variant<BezierSurface, BSplineSurface>;

core::Result<void> validate(const Surface& s);
core::Point3 evaluate(const Surface& s, double u, double v);
SurfaceJet jet(const Surface& s, double u, double v);

const Net& net_of(const Surface& s);
bool is_rational(const Surface& s);

/// Where derivatives may jump, from 0 to 1.
std::vector<double> breakpoints_u(const Surface& s);
std::vector<double> breakpoints_v(const Surface& s);

/// S(u, v) with u and v exchanged.
Surface transposed(const Surface& s);

/// The Bézier patches the surface consists of.
PatchGrid patches_of(const Surface& s);

}  // namespace keyline::surface
