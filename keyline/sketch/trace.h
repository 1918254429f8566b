#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/core/progress.h"
#include "keyline/curve/bezier.h"
#include "keyline/sketch/binarize.h"
#include "keyline/sketch/consolidate.h"
#include "keyline/sketch/image.h"
#include "keyline/sketch/rectify.h"
#include "keyline/sketch/stroke_curve.h"
#include "keyline/sketch/tone.h"

/// From a drawing to the curves it shows, [Sketch].
namespace keyline::sketch {

/// What of the ink is traced.
enum class Edge {
  center,  ///< the middle of its lines
  outer    ///< the outer border of its pieces, as in the paper
};
constexpr auto choices(const Edge*) {
  return core::words<Edge>({{Edge::center, "center"}, {Edge::outer, "outer"}});
}

/// How the ink's edges are smoothed, morphology.h.
enum class Smoothing {
  features,  ///< bumps and dents of a pixel alone
  pixels     ///< every edge, by plain erosion and dilation: [Sketch] Fig. 6b, to compare with
};
constexpr auto choices(const Smoothing*) {
  return core::words<Smoothing>({{Smoothing::features, "features"}, {Smoothing::pixels, "pixels"}});
}

/// The picture after one stage of the way, for those who want to see where it went wrong.
struct Stage {
  std::string name;              ///< "log", "binary", "smoothed", "edges", "lines"
  Raster<std::uint8_t> picture;  ///< 0 black, 255 white
};

struct TraceOptions {
  Rectify rectify = Rectify::automatic;
  std::optional<SheetCorners> sheet;  ///< in the picture; empty: found, where there is one
  ToneOptions tone;
  BinarizeOptions binarize;
  Edge edge = Edge::center;
  int smoothing = 2;  ///< passes of erosion and dilation, 0 … 100
  Smoothing smoothing_by = Smoothing::features;
  std::optional<int> specks;  ///< pieces of ink of fewer pixels go; empty: by the stroke width
  std::optional<double> gap;  ///< longest gap bridged, pixels; empty: by the stroke width
  bool consolidate = false;   ///< lines drawn several times become one
  GroupWishes wishes;         ///< of consolidating: see TraceResult
  StrokeCurveOptions curve;
  std::function<void(const Stage&)> stage;  ///< called after each stage where set
  core::Progress progress;
};

struct TraceResult {
  int width = 0;  ///< of the picture, or of the sheet in it
  int height = 0;
  std::optional<SheetCorners> sheet;  ///< that the photo was mapped back to
  std::vector<Stroke> strokes;        ///< longest first
  /// Share of the ink within half the line's width and a pixel of a curve, or of a pass as far as
  /// it lies within a pen and a half of the line that stands for it; of drawn strokes the share of
  /// their length beside the line they are members of. A note warns below 97 %.
  double explained = 1;
  std::vector<DrawnStroke> passes;     ///< what `members` count: drawn, or of a picture, before
                                       ///< it was consolidated
  std::vector<std::size_t> left_over;  ///< drawn strokes that no line stands for
  std::vector<std::string> notes;      ///< what was decided, left out or looks doubtful, in words
};

/// Traces a picture's lines. Strokes have pixels for a unit and y up: (0, 0) is the lower left
/// corner of the picture, or of the sheet of paper that it is a photo of.
///
/// Fails: undrawable where nothing in the picture looks like a line; bad_input for wishes about
/// what is not there and corners that are no sheet's; cancelled.
/// Cost:  linear in the pixels; some 7 bytes per pixel of an 8 bit picture, reading it included.
core::Result<TraceResult> trace(Image image, const TraceOptions& options = {});

/// The way from drawn strokes on (vector drawings): consolidated, then curves as from a picture.
/// Coordinates stay; options.curve counts in widths of the pen (`width`) instead of pixels.
/// Fails: bad_input for strokes that are not finite or all of one place, for wishes about what is
/// not there; cancelled.
core::Result<TraceResult> trace_strokes(const std::vector<DrawnStroke>& strokes, double width,
                                        const TraceOptions& options = {});

}  // namespace keyline::sketch
