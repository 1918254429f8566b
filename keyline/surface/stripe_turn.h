#pragma once

#include "keyline/surface/curvature.h"

namespace keyline::surface {

/// By how much zebra stripes turn where they cross a joint of two surfaces with one tangent plane:
/// the angle between the stripe on one side and on the other, in [0, pi], in the mean over all
/// lights, each stripe counted as often as it crosses. A zebra is any smooth function of the normal
/// (stripes of any width on walls of any place); of all of them the mean depends on curvature
/// alone. 0 where both forms agree, and where the normal stands still along the joint, because no
/// stripe crosses it there.
///
/// Both forms are in the frame (x across the joint, y along it), which the surfaces share; what
/// they differ by in xy and yy is taken to be rounding.
double stripe_turn(const CurvatureForm& first, const CurvatureForm& second);

/// How many stripes cross, per length of the joint and up to a factor that the light sets: the rate
/// at which the normal turns along it, in 1/length.
double stripe_density(const CurvatureForm& first, const CurvatureForm& second);

}  // namespace keyline::surface
