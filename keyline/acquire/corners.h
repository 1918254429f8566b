#pragma once

#include <cstddef>
#include <optional>
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
/// Increasing; ends of an open polygon are never listed.
std::vector<std::size_t> find_corners(std::span<const core::Point2> points, bool closed,
                                      double noise, double angle);

/// By how much a curve through the points, in order, that goes on beyond the last passes p: the
/// least of what polynomials of first to third degree say, each through twice as many of the last
/// points as it has terms. Nothing for fewer than six points, or where these turn too far for
/// polynomials.
std::optional<double> distance_beyond(std::span<const core::Point2> points, core::Point2 p);

/// Where curves through the points of two sides, either in order towards a corner that lies beyond
/// its last point, meet: lines through the last six points, or parabolas where the points tell
/// their bend. Nothing for fewer points, or where they do not meet ahead of both sides, at most
/// twice as far away as these are from each other.
std::optional<core::Point2> corner_beyond(std::span<const core::Point2> one,
                                          std::span<const core::Point2> other);

}  // namespace keyline::acquire
