#pragma once

#include <filesystem>
#include <string_view>

#include "keyline/core/error.h"
#include "keyline/document/document.h"
#include "keyline/exchange/file/written.h"

/// Glyphs of the Unified Font Object (UFO 3, .glif): one glyph per file, in font units, y up.
namespace keyline::exchange {

/// Contours as Béziers: "curve" points as cubics (as quadratics with one handle), "qcurve" points
/// as quadratics with implied nodes, contours that start with "move" open. Names as read_font().
/// Components are read from the folder (the UFO's contents.plist tells their files) with their
/// transforms, at most eight within each other and 10,000 outlines in all.
/// Skipped: components that are not found there, points that are anchors.
/// Fails: bad_input with "line N" for what is no XML or no glyph, and for points that are no
///        numbers.
core::Result<document::Document> read_glif(std::string_view bytes,
                                           const std::filesystem::path& folder = {});

struct GlifOptions {
  double tolerance = 0.5;  ///< of the cubics; > 0
  bool grid = false;       ///< whole numbers for nodes and handles
};

/// A glyph of cubics with nodes at corners, horizontal and vertical extrema and inflections, and
/// more only where the tolerance asks for them. Between two nodes the cubic with the curve's
/// tangents and curvatures at both ends is taken where it is within the tolerance (then joints of
/// G2 curves stay G2), else cubics with the tangents alone. Nodes where the outline is smooth say
/// so; the largest jump of curvature there is among the notes. The glyph is named after the layer
/// or name of the first path, and gets its code point where that is a single character. Deviation:
/// with `grid` including the rounding, measured at 33 places of every cubic. Fails: bad_input where
/// there is no planar path.
core::Result<Written> write_glif(const document::Document& document, const GlifOptions& options);

}  // namespace keyline::exchange
