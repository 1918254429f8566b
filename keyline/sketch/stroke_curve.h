#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/point.h"
#include "keyline/curve/bezier.h"
#include "keyline/fit/curvature_drive.h"
#include "keyline/fit/curvature_target.h"
#include "keyline/sketch/refine_stroke.h"

namespace keyline::sketch {

/// Which curvature quintics are driven to after they were fitted ([Sketch] section 6).
enum class CurvatureAim { none, smooth, rhythm };
constexpr auto choices(const CurvatureAim*) {
  return core::words<CurvatureAim>({{CurvatureAim::none, "none"},
                                    {CurvatureAim::smooth, "smooth"},
                                    {CurvatureAim::rhythm, "rhythm"}});
}

struct StrokeCurveOptions {
  double straightness = 0.75;  ///< of a group of points, pixels: see SegmentOptions
  double corner_angle = 0.6;   ///< radians
  /// Largest distance of a stroke's points from its curve in pixels (width_share of the width is
  /// always allowed): as few quintics as that takes. 0: one per vertex of the line segments, as in
  /// [Sketch] section 5.
  double tolerance = 0.5;
  double width_share = 0.1;
  /// Curves keep within three times the tolerance (of a picture, half the width if that is less)
  /// or 0.3 of the width of where they were.
  CurvatureAim aim = CurvatureAim::none;
  fit::WantedRhythm rhythm = fit::WantedRhythm::own;  ///< of aim rhythm
};

/// Root mean square of the curvature less its target, in 1 / pixel.
struct DriveReport {
  double before = 0;
  double after = 0;
};

/// One line of the drawing.
struct Stroke {
  std::vector<core::Point2> points;               ///< along the centre, a pixel apart
  std::vector<core::Point2> segments;             ///< the concatenated line segments
  std::vector<std::array<core::Point2, 2>> axes;  ///< principal axes of the groups of points
  std::vector<curve::Bezier2> quadratics;         ///< on midpoints and vertices of the segments
  std::vector<curve::Bezier2> curve;              ///< quintics, G2 but for corners
  std::vector<std::size_t> corners;               ///< pieces of `curve` that start with a corner
  std::vector<fit::CurvatureTarget> target;       ///< over all of `curve`; empty without an aim
  std::optional<DriveReport> driven;              ///< empty without an aim
  std::size_t straight_ended = 0;                 ///< stretches: see fit::RhythmTarget
  bool closed = false;
  double width = 0;            ///< of the ink, median; 0 for outlines
  std::vector<double> widths;  ///< of the ink at every point
  /// Drawn strokes it stands for, from 0; of a picture, where lines were consolidated, the lines
  /// that it has otherwise, longest first.
  std::vector<std::size_t> members;
};

/// The stroke in other units; curvature and widths by the mean of both scales.
void scale(Stroke& stroke, double across, double down);

/// The curve of a refined stroke: line segments, quadratics, quintics, joints, curvature. With the
/// picture it was read from, corners have to lie on its ink.
/// Precondition: at least two points.
Stroke curve_of(const FineStroke& fine, const StrokeCurveOptions& options,
                const Refiner* picture = nullptr);

}  // namespace keyline::sketch
