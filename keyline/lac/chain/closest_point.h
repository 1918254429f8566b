#pragma once

#include "keyline/curve/closest_point.h"
#include "keyline/lac/chain/chain.h"
#include "keyline/lac/segment/segment.h"

namespace keyline::lac {

/// The point of a segment or chain nearest to p; of several the one of smallest parameter, as far
/// as rounding can tell them apart. Faster than the generic one, because arc length is exact: a
/// stretch of length l whose ends are d0 and d1 away holds nothing nearer than (d0 + d1 - l) / 2.
/// Stretches that can win are halved until the squared distance is known to be convex or concave on
/// them, at most twenty times and 2,000 in all, then Newton's method in a bracket.
/// Accuracy: t to 1e-14 where the minimum is a plain one.
curve::ClosestPoint closest_point(const Segment& segment, core::Point2 p);
curve::ClosestPoint closest_point(const Chain& chain, core::Point2 p);

}  // namespace keyline::lac
