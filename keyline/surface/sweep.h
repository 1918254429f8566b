#pragma once

#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bspline.h"
#include "keyline/surface/bspline_surface.h"

/// Surfaces from curves. v runs along the profile (or the sections), u along the rail, around the
/// axis, or from section to section. Curves have to be valid.
namespace keyline::surface {

struct MadeSurface {
  BSplineSurface surface;
  /// Largest distance of the surface's control curves from their exact way; 0 where it is exact.
  double deviation = 0;
};

/// The profile moved along a vector: exact.
core::Result<BSplineSurface> extrude(const curve::BSpline3& profile, core::Vector3 by);

/// The profile moved along the rail without turning, S(u, v) = profile(v) + rail(u) - rail(0):
/// exact. The rail is polynomial (unsupported otherwise); a rational profile is allowed.
core::Result<BSplineSurface> translate(const curve::BSpline3& profile, const curve::BSpline3& rail);

/// The profile carried along the rail like a rigid body, with a frame that does not twist about the
/// rail's tangent (rotation minimising, by the double reflection
/// of [Wang 2008]). Cubic splines in u through the carried control points, as many as
/// hold `tolerance` (> 0, absolute), at four places between each two. Errors: bad_input for a
/// tolerance that is not positive; unsupported for a rail with a corner (tangent turning by more
/// than 1e-3 rad) or a place without tangent; not_converged where 513 places are not enough.
core::Result<MadeSurface> sweep(const curve::BSpline3& profile, const curve::BSpline3& rail,
                                double tolerance);

/// Axis of revolution.
struct Axis3 {
  core::Point3 point;
  core::Vector3 direction{0, 0, 1};
};

/// The profile turned about the axis by an angle in [-2 pi, 2 pi], right-handed, not 0: exact,
/// rational quadratic arcs of at most a right angle in u.
core::Result<BSplineSurface> revolve(const curve::BSpline3& profile, const Axis3& axis,
                                     double angle);

/// Passes exactly through two or more sections, in their order: cubic in u (lower for fewer than
/// four), u by the mean distance of the sections. All sections polynomial or with the same weights
/// after they have been brought to one degree and one knot vector (unsupported otherwise).
core::Result<BSplineSurface> loft(const std::vector<curve::BSpline3>& sections);

}  // namespace keyline::surface
