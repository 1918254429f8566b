#pragma once

#include <string>
#include <string_view>

namespace keyline::figure {

/// Valid UTF-8 on one line: control characters are dropped, line breaks and tabs become spaces,
/// bytes that are no UTF-8 become U+FFFD.
std::string clean_text(std::string_view text);

}  // namespace keyline::figure
