#pragma once

#include <vector>

#include "keyline/analysis/continuity.h"
#include "keyline/document/planar_curve.h"

/// Joints of paths whose curves may stop, have cusps, or rates of curvature that are infinite.
namespace keyline::operations {

/// Where the pieces of a path meet, cusps and stops of its curves included, in order; not its seam.
/// Precondition: the path is valid.
std::vector<analysis::InnerJoint> joints_inside(
    const document::Path& path, const analysis::ContinuityTolerance& tolerance = {});

/// Whether the rate of curvature is infinite at an end of a curve, which jets do not know: of a
/// chain whose curvature is 0 there, as its power is linear in arc length.
bool is_steep_at_start(const document::PlanarCurve& c);
bool is_steep_at_end(const document::PlanarCurve& c);

/// That joint where the rate is infinite on a side.
analysis::JointContinuity without_rate(analysis::JointContinuity joint);

}  // namespace keyline::operations
