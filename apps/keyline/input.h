#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/core/error.h"
#include "keyline/document/document.h"

#include "commands.h"

/// Files to key-lines or curves.
namespace keyline::app {

/// True for tables of points, which have to be acquired first.
bool holds_points(const std::string& file);

/// Key-lines to fair, one per curve of the input. Several files are parts of one. `page` becomes
/// that of a drawing, y up from its lower left corner.
core::Result<std::vector<acquire::KeyLine>> load_key_lines(
    const InputOptions& input, std::optional<curve::Box2>* page = nullptr);

/// The polyline that is the whole path, else null.
const curve::Polyline2* only_polyline(const document::Path& path);

/// A curve of a file as a key-line: vertices of a polyline are measured points in their order,
/// other curves are sampled.
core::Result<acquire::KeyLine> key_line_of(const document::Path& path, const InputOptions& input);

/// What --select leaves of a file of curves (bad_input for several files).
core::Result<document::Document> load_document(const InputOptions& input);

/// The same with space curves that lie in a plane as planar ones (bad_input where none is planar).
core::Result<document::Document> load_planar(const InputOptions& input);

}  // namespace keyline::app
