#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keyline/acquire/key_line.h"
#include "keyline/core/error.h"
#include "keyline/document/document.h"
#include "keyline/sketch/trace.h"

/// What the doors and sketch.trace share about drawings.
namespace keyline::operations {

/// Options of a sketch.trace request (bad_input with the field's name otherwise).
core::Result<sketch::TraceOptions> trace_options(const nlohmann::json& request);

/// sketch::trace; unsupported where Keyline was built without room sketch.
core::Result<sketch::TraceResult> trace_picture(sketch::Image image,
                                                const sketch::TraceOptions& options);
/// sketch::trace_strokes, likewise.
core::Result<sketch::TraceResult> trace_drawn(const std::vector<sketch::DrawnStroke>& strokes,
                                              double width, const sketch::TraceOptions& options);

/// The result of sketch.trace, lengths times `scale`.
nlohmann::json sketch_json(const sketch::TraceResult& trace, double scale);

/// The strokes "stroke1", "stroke2", … with their widths: coordinates times `scale`, moved up by
/// `lift`.
document::Document sketch_document(const sketch::TraceResult& trace, double scale, double lift);

/// Strokes as key-lines to fair, in pixels; short ones (under eight widths) are left out and
/// counted in `skipped`.
core::Result<std::vector<acquire::KeyLine>> key_lines_of(const sketch::TraceResult& trace,
                                                         std::size_t& skipped);

}  // namespace keyline::operations
