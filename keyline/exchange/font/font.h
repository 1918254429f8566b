#pragma once

#include <string>
#include <string_view>

#include "keyline/core/error.h"
#include "keyline/document/document.h"

namespace keyline::exchange {

/// Outlines of glyphs of a TrueType or OpenType font, through FreeType, in font units (y up, not
/// hinted, not scaled): quadratic or cubic Béziers, one closed path per contour.
///
/// `glyphs`: characters ("Sa"), names of the font ("/ampersand") or code points ("U+0053"), the
/// latter two one at a time. The layer of a path is its
/// glyph, its name the glyph's with "#2", "#3" … for further contours. The unit is empty.
/// Fails: bad_input for what is no font, a glyph it does not have (path "--glyphs"), fonts of
/// bitmaps
///        alone, and glyphs without outline; FreeType is given the bytes, never a file name.
core::Result<document::Document> read_font(std::string_view bytes, const std::string& glyphs);

}  // namespace keyline::exchange
