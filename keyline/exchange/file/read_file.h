#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "keyline/core/error.h"

namespace keyline::exchange {

/// Bytes a file may hold that is read whole.
inline constexpr std::uintmax_t kLargestFile = std::uintmax_t{512} << 20;

/// A file to read from its start, byte by byte. Fails: io where it is a folder or cannot be opened.
core::Result<std::ifstream> open_file(const std::filesystem::path& file);

/// The whole of a file.
/// Fails: io where it cannot be opened or read; bad_input where it holds more than `largest` bytes.
core::Result<std::string> read_file(const std::filesystem::path& file,
                                    std::uintmax_t largest = kLargestFile);

/// Bytes at the start of a file that tell its format.
inline constexpr std::size_t kHead = 1024;

/// The first kHead bytes of a file, for format_of(); io as open_file().
core::Result<std::string> head_of(const std::filesystem::path& file);

/// A failure with the file in front of its place: "file:12" for "line 12", else "file: place".
core::Failure in_file(core::Failure failure, const std::string& file);

}  // namespace keyline::exchange
