#pragma once

#include <string>
#include <string_view>

#include "keyline/figure/drawing.h"

namespace keyline::figure::detail {

/// Base 64 with padding (RFC 4648).
std::string base64(std::string_view bytes);

/// PNG bytes of a picture's pixels; the picture must be valid.
std::string png_of_pixels(const Picture& picture);

}  // namespace keyline::figure::detail
