#pragma once

#include <map>
#include <string>
#include <vector>

#include "keyline/document/document.h"

namespace keyline::exchange::detail {

/// What the layers of a document are called in a DXF: allowed there, and no two the same but for
/// small and large letters. Those that can be keep their names; the layer without one is "0".
std::map<std::string, std::string> dxf_layers(const document::Document& document);

/// Says which of these, and which names of curves, a reader finds otherwise than they were.
std::vector<std::string> changed_names(const document::Document& document,
                                       const std::map<std::string, std::string>& layers);

}  // namespace keyline::exchange::detail
