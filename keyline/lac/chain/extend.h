#pragma once

#include <optional>

#include "keyline/core/error.h"
#include "keyline/lac/chain/chain.h"
#include "keyline/lac/segment/segment.h"

/// Longer and mirrored curves. To trim one take part() of it.
namespace keyline::lac {

/// How far a piece's own law goes on beyond its ends, in length; infinite where it never stops.
/// For alpha > 0 the law ends where curvature becomes infinite, beyond the end of larger curvature
/// at rho / (alpha |drho/ds|); for alpha <= 0, circles and straight lines it does not end: for
/// alpha < 0 it runs through its inflection with the sign of curvature changed.
struct NaturalBounds {
  double before = 0;
  double after = 0;
};
NaturalBounds natural_bounds(const Piece& piece);

/// The same curve run on by the given lengths (0 or more) before its start and after its end.
/// Fails: bad_input (a length negative or not finite); undrawable at or past the natural bound,
/// which the hint states, and where the longer piece would turn by more than 1e5 radians.
core::Result<Segment> extend(const Segment& segment, double before, double after);
/// The first and the last piece run on; not for a closed chain (bad_input).
core::Result<Chain> extend(const Chain& chain, double before, double after);

/// Mirror image in the line through a point in a direction.
Segment mirrored(const Segment& segment, const core::Pose2& line);
Chain mirrored(const Chain& chain, const core::Pose2& line);

namespace detail {

/// Curvature at arc length s >= 0 from where it is `curvature` and changes at `rate`, by the law of
/// slope alpha: kappa (1 - alpha rate/kappa s)^(-1/alpha). Empty past the natural bound, and where
/// curvature is zero (unless alpha = -1).
std::optional<double> curvature_continued(double alpha, double curvature, double rate, double s);

}  // namespace detail
}  // namespace keyline::lac
