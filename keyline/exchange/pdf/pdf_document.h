#pragma once

#include "keyline/core/error.h"
#include "keyline/document/document.h"
#include "keyline/exchange/file/written.h"

namespace keyline::exchange {

/// Paths as one page of PDF 1.5 in real size, drawn as in the SVG file: cubic Béziers within
/// `tolerance` (> 0), colours, line widths, a layer that can be switched off for every layer of the
/// document. The page is tight around the curves plus the SVG file's margin, in whole points; a
/// drawing larger than a page may be (5.08 m) is scaled by a power of ten, which a note says.
/// Numbers have twelve significant digits of the drawing's size. Space curves and surfaces are left
/// out and noted. Fails: bad_input for paths that have no extent or are too large for numbers.
core::Result<Written> write_pdf_document(const document::Document& document, double tolerance);

}  // namespace keyline::exchange
