#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/bounding_box.h"

namespace keyline::exchange {

/// Pieces in drawing order; where one does not start exactly where the last ended, the pen is
/// lifted.
struct SvgPath {
  std::string name = {};
  std::vector<curve::Bezier2> pieces = {};
  bool closed = false;     ///< ends where it starts
  std::string color = {};  ///< "#rrggbb"; empty: the layer's
  double width = 0;        ///< of the line, in the drawing's unit; 0: the layer's
};

/// A named layer with one look.
struct SvgLayer {
  std::string name = {};
  std::vector<SvgPath> paths = {};
  std::string color = "#0b5394";  ///< "#rrggbb"
  double width = 1;               ///< of the line, times that of the options
};

struct SvgWriteOptions {
  std::string unit = "mm";  ///< of the coordinates: mm, cm, in, pt, px, m, or empty for px
  double stroke_width = 0;  ///< in that unit; 0: a four-hundredth of the drawing's size
  double margin = 0.03;     ///< on every side, as a share of the drawing's larger side
  std::optional<curve::Box2> page = {};  ///< what is shown, y up, without margin; empty: the curves
  std::string title = {};
  std::string metadata = {};  ///< JSON that read_svg() gives back exactly; empty: none
};

/// Writes curves as an SVG document: real size in the unit given, viewBox tight around the curves
/// plus margin, one group (an Inkscape layer) per layer. Coordinates are the curves' own with y
/// negated (SVG counts it downwards), printed so that they read back to the same doubles.
/// Where a page is given, the viewBox is that page.
///
/// Fails: bad_input for numbers that are not finite, a colour that is none, an unknown unit, text
///        that is not UTF-8 or, in metadata, control characters; unsupported for rational pieces
///        and degrees other than 1 to 3 (approximate those first).
core::Result<std::string> write_svg(const std::vector<SvgLayer>& layers,
                                    const SvgWriteOptions& options = {});

}  // namespace keyline::exchange
