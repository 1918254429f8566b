#pragma once

#include <string>

namespace keyline::document {

/// 0xRRGGBB of a label's "#rrggbb"; -1 for other text.
int color_value(const std::string& text);

}  // namespace keyline::document
