#pragma once

#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/core/error.h"
#include "keyline/document/document.h"
#include "keyline/sketch/trace.h"

/// Tracing of drawings as the operation sketch.trace and the programs over it share it.
namespace keyline::operations {

/// sketch::trace; unsupported where Keyline was built without room sketch.
core::Result<sketch::TraceResult> trace_picture(sketch::Image image,
                                                const sketch::TraceOptions& options);
/// sketch::trace_strokes, likewise.
core::Result<sketch::TraceResult> trace_drawn(const std::vector<sketch::DrawnStroke>& strokes,
                                              double width, const sketch::TraceOptions& options);

/// A stroke's quintics, mapped.
document::Path path_of(const sketch::Stroke& stroke, const core::Similarity2& map);

/// Strokes as key-lines to fair, in pixels; short ones (under eight widths) are left out and
/// counted in `skipped`.
core::Result<std::vector<acquire::KeyLine>> key_lines_of(const sketch::TraceResult& trace,
                                                         std::size_t& skipped);

}  // namespace keyline::operations
