#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "keyline/lac/g2/spline.h"

/// Internals of the G2 spline: where it sets out and which way, so that the curve found does not
/// depend on what the request calls first.
namespace keyline::lac::detail {

/// A way to travel the points of a request: from one of them (open: an end), on or back.
struct SplineStart {
  std::size_t point = 0;
  bool backwards = false;
  std::size_t spans = 0;

  /// What the request calls the i-th span, and the i-th point, on this way.
  std::size_t span(std::size_t i) const {
    return (backwards ? point + 2 * spans - 1 - i : point + i) % spans;
  }
  /// points: of the request, as many as spans where it is closed.
  std::size_t at(std::size_t i, std::size_t points) const {
    return (backwards ? point + points - i : point + i) % points;
  }
  /// The other way from the same point of a closed request, from the other end of an open one.
  SplineStart other_way(bool closed) const {
    return {closed ? point : spans - point, !backwards, spans};
  }
};

/// Told by chords, turns, slopes and end conditions, of which nothing depends on the first point,
/// the direction of travel, place, size or a mirror. Ways that these do not tell apart are those of
/// a polygon that is symmetric or repeats itself. Input checked by the caller. Cost: n log n.
SplineStart spline_start(std::span<const core::Point2> points, const SplineOptions& options);

/// The request travelled that way, and the answer to it travelled as the request was given (but
/// for its start).
std::vector<core::Point2> travelled(std::span<const core::Point2> points, const SplineStart& way);
SplineOptions travelled(const SplineOptions& options, const SplineStart& way);
SplineSolution as_asked(const SplineSolution& solution, const SplineStart& way);

}  // namespace keyline::lac::detail
