#pragma once

#include <filesystem>
#include <string>

namespace keyline::exchange {

/// Whether a name means standard input or output: "-", or "svg:-" where the format is to be told.
bool is_standard_stream(const std::filesystem::path& file);

/// ".svg" and the like, in lower case; empty where the name has none. Of "svg:-" it is ".svg", of
/// "-", which is written as JSON, ".json".
std::string extension_of(const std::filesystem::path& file);

}  // namespace keyline::exchange
