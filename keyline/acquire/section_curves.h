#pragma once

#include <vector>

#include "keyline/acquire/plane.h"
#include "keyline/acquire/raw_curve.h"

namespace keyline::acquire {

/// The curves that the points of a cloud's section lie on, longest first, each in its order.
///
/// Points whose neighbourhood is as wide as it is long (a wheel's tread met flat) lie on no curve
/// and are left out; the rest falls apart at gaps far wider than its usual spacing, and side
/// branches of a part become curves of their own. Parts of a few points are left out. A section
/// that is one curve comes back as it is, its points in their own order. Names are section-1,
/// section-2, …; notes of the first tell what was left out.
///
/// Precondition: the points lie on the plane (section_plane() moves them there).
std::vector<RawCurve> section_curves(const RawCurve& section, const Plane& plane);

}  // namespace keyline::acquire
