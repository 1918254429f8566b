#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "keyline/core/error.h"

namespace keyline::exchange {

/// Bytes a file may hold that is read whole.
inline constexpr std::uintmax_t kLargestFile = std::uintmax_t{512} << 20;

/// The whole of a file.
/// Fails: io where it cannot be opened or read; bad_input where it holds more than `largest` bytes.
core::Result<std::string> read_file(const std::filesystem::path& file,
                                    std::uintmax_t largest = kLargestFile);

/// The first 1024 bytes of a file, for format_of(); io as read_file().
core::Result<std::string> head_of(const std::filesystem::path& file);

/// A failure with the file in front of its place: "file:12" for "line 12", else "file: place".
core::Failure in_file(core::Failure failure, const std::string& file);

}  // namespace keyline::exchange
