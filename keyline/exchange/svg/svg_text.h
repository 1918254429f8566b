#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"

namespace keyline::exchange::detail {

/// The text of an SVG file as UTF-8.
struct SvgText {
  std::string own = {};                 ///< empty where the bytes are used as they are
  std::vector<std::string> notes = {};  ///< what was left out
  std::string_view in(std::string_view bytes) const { return own.empty() ? bytes : own; }
};

/// Uncompresses (.svgz: at most ten times the file and 10 MB more, so that no small file fills the
/// memory), turns UTF-16, ISO 8859-1 and Windows-1252 into UTF-8 (of other encodings that hold
/// ASCII, the names come out wrong, with a note) and puts in the entities the document type
/// defines: those with a value in the file, nested at most eight deep, growing the text by at most
/// half and 1 MB; files outside are never looked at. Fails: bad_input where the compressed data are
/// broken or too large; unsupported for other encodings.
core::Result<SvgText> svg_text(std::string_view bytes, std::size_t largest);

/// The text as an .svgz file: the same bytes for the same text.
std::string compressed_svg(std::string_view text);

}  // namespace keyline::exchange::detail
