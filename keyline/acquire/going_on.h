#pragma once

#include <optional>
#include <span>

#include "keyline/core/point.h"

/// Where curves through measured points go on beyond the last of them.
namespace keyline::acquire {

/// By how much a curve through the points, in order, that goes on beyond the last passes p: the
/// least of what polynomials of first to third degree say, each through twice as many of the last
/// points as it has terms. Nothing for fewer than six points, or where these turn too far for
/// polynomials.
std::optional<double> distance_beyond(std::span<const core::Point2> points, core::Point2 p);

/// The same of the last of the points and those before it.
std::optional<double> distance_of_last(std::span<const core::Point2> points);

/// Where curves through the points of two sides, either in order towards a corner that lies beyond
/// its last point, meet: lines through the last six points, or parabolas where the points tell
/// their bend. Nothing for fewer points, or where they do not meet ahead of both sides, at most
/// twice as far away as these are from each other.
std::optional<core::Point2> corner_beyond(std::span<const core::Point2> one,
                                          std::span<const core::Point2> other);

}  // namespace keyline::acquire
