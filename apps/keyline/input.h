#pragma once

#include <string>
#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/core/error.h"
#include "keyline/document/planar_curve.h"

#include "commands.h"

/// Files to key-lines or curves.
namespace keyline::app {

/// What an input file holds: points still to be acquired, or curves.
enum class InputKind { points, json, svg };

/// ".svg" and the like, in lower case; empty where the name has none.
std::string extension_of(const std::string& file);

InputKind kind_of(const std::string& file);

/// Key-lines to fair, one per curve of the input. Several files are parts of one.
core::Result<std::vector<acquire::KeyLine>> load_key_lines(const InputOptions& input);

/// Curves as they stand in a json or svg file (bad_input for points).
core::Result<document::Document> load_document(const InputOptions& input);

/// The whole of a file, at most 512 MB; "-" is standard input.
core::Result<std::string> read_file(const std::string& file);

}  // namespace keyline::app
