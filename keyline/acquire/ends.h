#pragma once

#include <span>

#include "keyline/core/point.h"

namespace keyline::acquire {

/// How the two ends of an ordered polygon stand to each other.
enum class Ends {
  apart,            ///< an open curve
  closed,           ///< the curve goes on smoothly from last to first point, one spacing apart
  closed_repeated,  ///< the same with the first point repeated at the end
  corner_repeated,  ///< first and last point are one place, and a corner (sharp trailing edge)
  corner_at_first,  ///< closed, not repeated, with a corner at the first point
  corner_at_last,   ///< closed, not repeated, with a corner at the last point
  blunt,            ///< close together, both corners (trailing edge of finite thickness): open
};

/// Recognises closed outlines from the gap between the ends against the spacing beside it
/// (`stride` points apart where points are denser than their noise). Fewer than 8 points are
/// closed only where the first is repeated. scattered: the points were drawn without regard to
/// spacing (a random sample), so that a gap of a twentieth of the length, or one as wide as a loop
/// of so many points has by chance in one case of a hundred, still closes where the curve runs
/// straight across it.
/// noise: standard deviation of a point's position; what it explains of turns is no corner at the
/// ends and hides none. What a curve turns that bends more and more towards them is none either.
Ends recognise_ends(std::span<const core::Point2> points, std::size_t stride,
                    bool scattered = false, double noise = 0);

}  // namespace keyline::acquire
