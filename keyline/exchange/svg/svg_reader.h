#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/bounding_box.h"

namespace keyline::exchange {

/// One run of Bézier pieces, end to end.
struct SvgCurve {
  std::string name = {};   ///< label or id of its element, "#2", "#3" … behind for later subpaths
  std::string layer = {};  ///< label or id of the nearest named group; may be empty
  std::vector<curve::Bezier2> pieces = {};  ///< degree 1 to 3; rational quadratics for arcs
  bool closed = false;
  std::string color = {};   ///< "#rrggbb" of the stroke, else of the fill; empty: none stated
  double stroke_width = 0;  ///< in the unit of the coordinates; 0: no stroke
  std::size_t subpath = 1;  ///< of its element, counted from 1
};

/// Something of the file that is not among the curves, or not all of it.
struct SvgSkipped {
  int line = 0;
  std::string what = {};
};

struct SvgContents {
  std::vector<SvgCurve> curves = {};
  std::string unit = {};                 ///< "mm" where the file states a physical size, else "px"
  std::optional<curve::Box2> page = {};  ///< what the file shows, where it says so
  std::string metadata = {};             ///< our own JSON exactly as write_svg() got it; else empty
  std::vector<SvgSkipped> skipped = {};
};

/// Bounds that keep hostile files from using up the machine.
struct SvgReadLimits {
  std::size_t bytes = std::size_t{256} << 20;
  int depth = 200;                             ///< of nested elements
  int use_depth = 16;                          ///< of <use> within <use>
  std::size_t memory = std::size_t{24} << 20;  ///< for curves, beside 17 times the file
  std::size_t elements = 2'000'000;  ///< visited beside one in four bytes; repeated ones count
};

/// Reads the curves of an SVG file: paths and basic shapes under nested transforms, viewBoxes,
/// groups, nested <svg>, <symbol>, <switch> and <use>. UTF-8, UTF-16, ISO 8859-1, Windows-1252
/// and compressed files (.svgz), see svg_text(). Hidden things are read all the same.
///
/// Style:   colour and width of strokes (svg_style.h); the rest is ignored.
/// Layers:  the nearest Inkscape layer around; outside of such, the nearest named group.
///
/// Frame:   y up: a point of the file's outermost user space (x, y) comes back as scale * (x, -y),
///          so what write_svg() wrote in mm comes back bit for bit. scale turns user units into
///          mm where the file states a physical size, else into px. A transform of the root element
///          moves the page, in px about its middle.
/// Skipped: text, images and other elements that hold no curve are counted by name; paths whose
///          data end in an error are read up to it; nothing outside the file is looked at.
/// Fails:   bad_input with path "line N" where the bytes are no XML or hold no <svg>, where
///          compressed data are broken; unsupported for other encodings; bad_input where the file
///          is larger than the limits. A file without any curve is no failure.
core::Result<SvgContents> read_svg(std::string_view bytes, const SvgReadLimits& limits = {});

}  // namespace keyline::exchange
