#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

#include "keyline/core/error.h"

namespace keyline::exchange {

/// Writes a file beside `path` and renames it into place, so that `path` holds either what it held
/// before or the whole new content. `write` is given a binary stream; a failure it returns, an
/// exception it throws, or a stream that went bad leaves `path` untouched and nothing beside it.
/// A path that is no regular file (a pipe, /dev/stdout) is written directly.
/// Returns: io where the file cannot be written, with the system's reason.
core::Result<void> write_atomically(const std::filesystem::path& path,
                                    const std::function<core::Result<void>(std::ostream&)>& write);

/// The same for content that is ready.
core::Result<void> write_atomically(const std::filesystem::path& path, std::string_view content);

}  // namespace keyline::exchange
