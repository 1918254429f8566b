#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/core/progress.h"
#include "keyline/curve/bezier.h"
#include "keyline/sketch/binarize.h"
#include "keyline/sketch/image.h"
#include "keyline/sketch/tone.h"

/// From a drawing to the curves it shows, [Sketch].
namespace keyline::sketch {

struct TraceOptions {
  ToneOptions tone;
  BinarizeOptions binarize;
  int smoothing = 2;           ///< rounds of feature-based erosion and dilation
  std::optional<int> specks;   ///< pieces of ink of fewer pixels go; empty: by the stroke width
  std::optional<double> gap;   ///< longest gap bridged, pixels; empty: by the stroke width
  double straightness = 0.75;  ///< of a group of points, pixels: see SegmentOptions
  double corner_angle = 0.6;   ///< radians
  /// Largest distance of a stroke's points from its curve in pixels (at least a tenth of the width
  /// is allowed): as few quintics as that takes. 0: two or more per line segment group, as in
  /// [Sketch] section 5.
  double tolerance = 0.5;
  core::Progress progress;
};

/// One line of the drawing. Coordinates in pixels with y up: (0, 0) is the lower left corner of the
/// picture.
struct Stroke {
  std::vector<core::Point2> points;    ///< along the centre, a pixel apart
  std::vector<core::Point2> segments;  ///< the concatenated line segments
  std::vector<curve::Bezier2> curve;   ///< quintics, G2 but for corners
  std::vector<std::size_t> corners;    ///< pieces of `curve` that start with a corner
  bool closed = false;
  double width = 0;  ///< of the ink, median
};

struct TraceResult {
  int width = 0;  ///< of the picture
  int height = 0;
  std::vector<Stroke> strokes;     ///< longest first
  std::vector<std::string> notes;  ///< what was decided, left out or looks doubtful, in words
};

/// Traces a picture's lines.
///
/// Fails: undrawable where nothing in the picture looks like a line; cancelled.
/// Cost:  linear in the pixels; at most some 12 bytes per pixel beside the image itself.
core::Result<TraceResult> trace(Image image, const TraceOptions& options = {});

}  // namespace keyline::sketch
