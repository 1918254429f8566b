#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::acquire {

/// Vertices of an ordered polygon where its direction jumps: the turn at the vertex is at least
/// `angle` (radians), twice what its standard error from `noise` allows at 5 sigma, 2.5 times the
/// turn of the curve on either side and 3 times the usual turn at a vertex, so that a tight but
/// sampled bend (the nose of an airfoil) is none. Where points beside stand closer, what counts is
/// what a curve as bent as theirs would turn over the vertex' own arms; beside a turn by a right
/// angle or more, what turns the other way does not count. A kink between very smooth
/// runs counts from a sixth of the angle on, if it is 12 times as sharp as all around it.
/// A corner may lie between two points, the first of which stands for it then: both together turn
/// twice as much as one vertex has to, and curves through the points of both sides go on to a place
/// in that edge, round which it is no farther than from point to point beside (going_on.h).
/// Increasing; ends of an open polygon are never listed.
std::vector<std::size_t> find_corners(std::span<const core::Point2> points, bool closed,
                                      double noise, double angle);

}  // namespace keyline::acquire
