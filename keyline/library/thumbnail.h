#pragma once

#include <string>

#include "keyline/document/document.h"

namespace keyline::library {

/// The one thing of the document as a small picture: an SVG document of 96 by 96 px, one line in
/// the colour of the text around it. Space curves and surfaces are seen from the corner (1, 1, 1),
/// surfaces as the lines of three parameters each way. The same thing gives the same bytes.
std::string thumbnail(const document::Document& thing);

}  // namespace keyline::library
