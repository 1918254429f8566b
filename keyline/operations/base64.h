#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace keyline::operations {

/// The bytes of base 64 text (RFC 4648, padded or not; white space is skipped), or empty where it
/// is none. A leading "data:…;base64," is let pass.
std::optional<std::string> decode_base64(std::string_view text);

/// The bytes as base 64 text, padded.
std::string encode_base64(std::string_view bytes);

}  // namespace keyline::operations
