#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/lac/chain/chain.h"

/// G2 splines of log-aesthetic pieces through given points (docs/design/g2-chains.md).
namespace keyline::lac {

/// Conditions at one end of an open spline. None: the end span is a circular arc. One of them: the
/// end span stays one piece; both: it gets a joint at half its length.
struct SplineEnd {
  std::optional<double> direction;  ///< of travel, radians
  std::optional<double> curvature;  ///< signed
};

struct SplineOptions {
  /// Slope alpha: empty (-1: a clothoid spline), one for all spans, or one per span.
  std::vector<double> alpha;
  bool closed = false;
  SplineEnd start;
  SplineEnd end;
};

struct SplineSolution {
  Chain chain;
  std::vector<std::size_t> span;  ///< of each piece of the chain: between points span and span + 1
  /// Spans whose slope is -1 instead of the one asked for: because curvature changes sign there
  /// (slopes from 0 on), or comes near it and no curve of the slopes asked for was found, or only
  /// one with a needle.
  std::vector<std::size_t> overridden;
  bool span_by_span = false;  ///< the spline of one piece per span would have been wild
  double deviation = 0;  ///< largest distance of the chain's joints from the points, and of its end
  int iterations = 0;    ///< of Newton's method, all in all
};

/// The chain through the points in order with continuous direction and curvature, one piece per
/// span. Of the curves that do this the one reached without a jump from the straight line when its
/// points are laid out straight and folded back, as far as the fast way does not find one that
/// turns by less than pi in every span. Where it sets out and which way chords, turns, slopes and
/// end conditions tell: where there are several splines the one found is the same whichever end, or
/// point of a closed one, is named first, in a mirror and of another size.
///
/// Points on a circle give the circle; with its end directions, points of one log-aesthetic segment
/// give the segment. A closed spline may repeat its first point at the end. Cost: linear in points.
/// Accuracy: directions agree within 1e-12 rad, curvatures are shared exactly.
/// Fails: bad_input (fewer than two points, closed: three; neighbours that coincide, path
/// "points[i]"; end conditions on a closed spline); not_converged where the slopes wanted cannot be
/// reached, with how far they were.
///
/// Never a wild curve: where the spline would turn by more than 3 pi / 2 in a span, or be 12 times
/// as long as its chord, or does not exist, tangents and curvatures at the points are set from
/// their neighbours alone and each span is solved for itself by up to three pieces (solve_g2):
/// span_by_span is true. not_converged with the span where even that fails.
core::Result<SplineSolution> solve_spline(std::span<const core::Point2> points,
                                          const SplineOptions& options = {});

}  // namespace keyline::lac
