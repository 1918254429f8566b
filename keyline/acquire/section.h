#pragma once

#include "keyline/acquire/plane.h"
#include "keyline/acquire/raw_curve.h"
#include "keyline/core/error.h"

namespace keyline::acquire {

enum class Axis { x, y, z };

/// Points of a cloud within `band` of the plane axis = position, moved onto the plane (along the
/// surface where its slope across the plane shows in the neighbours), in the order of the cloud
/// (acquire_key_line puts them in order along the curve), of several at one place the first with
/// the weight of all. The first note of the cut tells how many. Returns bad-input where the cloud
/// is planar, the band is not positive, or fewer than 3 points lie in it; the hint names the band
/// that would hold 3.
core::Result<RawCurve> section_plane(const RawCurve& cloud, Axis axis, double position,
                                     double band);

/// The same for any plane.
core::Result<RawCurve> section_plane(const RawCurve& cloud, const Plane& plane, double band);

}  // namespace keyline::acquire
