#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/exchange/file/standard_stream.h"

namespace keyline::exchange {

/// What room exchange reads or writes. points: tables of coordinates as text; scap: pen strokes.
enum class Format { points, json, svg, dxf, step, iges, mesh, font, glif, offsets, scap };

/// The extension that tells what a file is: its own where it is one of ours or a picture's, else
/// that of what its first bytes look like; empty for tables of points and what nobody knows.
std::string telling_extension(const std::filesystem::path& file, std::string_view head);

/// ".png", ".jpg", ".tif" or ".webp" by the first bytes; empty for what is no such picture.
std::string_view picture_extension(std::string_view head);

/// By the extension; where that says nothing, by the first bytes of the content; points otherwise.
Format format_of(const std::filesystem::path& file, std::string_view head = {});

/// Extensions of the formats that write_document() writes, each with its dot.
std::vector<std::string> written_extensions();

}  // namespace keyline::exchange
