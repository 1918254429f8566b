#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "keyline/document/document.h"
#include "keyline/exchange/file/written.h"
#include "keyline/exchange/svg/svg_writer.h"

namespace keyline::exchange {

/// Which paths of a document stand in a layer of its drawing.
struct DrawnLayer {
  std::string name = {};
  std::vector<std::size_t> paths = {};  ///< indices, in their order
};

/// One layer per layer of the document, in the order of first appearance; paths without layer one
/// each under their own name.
std::vector<DrawnLayer> drawn_layers(const document::Document& document);

/// What is drawn of a document: its paths as cubic Béziers within `tolerance` (> 0), in those
/// layers, with colours and stroke widths. The deviation, and notes of what is left out, go into
/// `written`.
std::vector<SvgLayer> drawing_layers(const document::Document& document, double tolerance,
                                     Written& written);

/// How that drawing is written: in the document's unit (mm where it has none), on its page, its
/// title telling the deviation in `written`.
SvgWriteOptions drawing_options(const document::Document& document, const Written& written);

}  // namespace keyline::exchange
