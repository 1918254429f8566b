#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::acquire {

/// Vertices of an ordered polygon where its direction jumps: the turn at the vertex is at least
/// `angle` (radians), stands clear of what `noise` explains, and is several times the turning of
/// the curve on either side, so that a tight but sampled bend (the nose of an airfoil) is none.
/// Increasing; ends of an open polygon are never listed.
std::vector<std::size_t> find_corners(std::span<const core::Point2> points, bool closed,
                                      double noise, double angle);

}  // namespace keyline::acquire
