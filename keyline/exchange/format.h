#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace keyline::exchange {

/// What room exchange reads or writes. points: tables of coordinates as text.
enum class Format { points, json, svg, dxf, step, iges, mesh, font, glif, offsets };

/// ".svg" and the like, in lower case; empty where the name has none.
std::string extension_of(const std::filesystem::path& file);

/// By the extension; where that says nothing, by the first bytes of the content; points otherwise.
Format format_of(const std::filesystem::path& file, std::string_view head = {});

/// Extensions of the formats that write_document() writes, each with its dot.
std::vector<std::string> written_extensions();

}  // namespace keyline::exchange
