#pragma once

#include <string>
#include <string_view>

#include "keyline/document/document.h"

namespace keyline::exchange {

/// What things of the document carry beside their geometry and a file of that kind has no place
/// for, in words: "names, colours"; empty where nothing is lost.
std::string lost_labels(const document::Document& document, std::string_view extension);

}  // namespace keyline::exchange
