#pragma once

#include <string>
#include <string_view>

#include "keyline/core/error.h"
#include "keyline/document/document.h"
#include "keyline/exchange/file/written.h"

namespace keyline::exchange {

/// The drawing of an SVG file as a document. A file write_svg_document() made gives back the very
/// document that was written, from its metadata. Names, layers, colours and widths that were
/// changed since are the drawing's; where curves were, the drawing counts alone
/// and `skipped` says so. What else others put into it is told as of any file.
/// Fails as read_svg() and document_from_json().
core::Result<document::Document> read_svg_document(std::string_view bytes);

/// Paths as cubic Béziers within `tolerance` (> 0), one SVG layer per layer of the document (paths
/// without layer: one each under their own name), with colours, stroke widths and, as metadata, the
/// document itself. Space curves are left out of the drawing and noted. The deviation stands in the
/// title too.
core::Result<Written> write_svg_document(const document::Document& document, double tolerance);

}  // namespace keyline::exchange
