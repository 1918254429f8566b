#include "keyline/operations/sketch_run.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "keyline/acquire/acquire.h"
#include "keyline/core/polygon.h"
#include "keyline/core/text.h"

namespace keyline::operations {
using core::ErrorCode;
using core::Result;

document::Path path_of(const sketch::Stroke& stroke, const core::Similarity2& map) {
  document::Path path;
  path.closed = stroke.closed;
  for (const curve::Bezier2& piece : stroke.curve)
    path.curves.push_back({curve::transform(piece, map)});
  return path;
}

Result<sketch::TraceResult> trace_picture([[maybe_unused]] sketch::Image image,
                                          [[maybe_unused]] const sketch::TraceOptions& options) {
#ifdef KEYLINE_HAS_SKETCH
  const std::size_t further = image.further_pages;
  auto traced = sketch::trace(std::move(image), options);
  if (traced && further > 0)
    traced->notes.push_back(core::counted(further, "further page") +
                            " of the file left out: the first is what is read");
  return traced;
#else
  return core::fail(ErrorCode::unsupported, "this Keyline was built without room sketch",
                    "build it with -DKEYLINE_SKETCH=ON");
#endif
}

Result<sketch::TraceResult> trace_drawn(
    [[maybe_unused]] const std::vector<sketch::DrawnStroke>& strokes, [[maybe_unused]] double width,
    [[maybe_unused]] const sketch::TraceOptions& options) {
#ifdef KEYLINE_HAS_SKETCH
  return sketch::trace_strokes(strokes, width, options);
#else
  return core::fail(ErrorCode::unsupported, "this Keyline was built without room sketch",
                    "build it with -DKEYLINE_SKETCH=ON");
#endif
}

Result<std::vector<acquire::KeyLine>> key_lines_of(const sketch::TraceResult& trace,
                                                   std::size_t& skipped) {
  constexpr double kPositionError = 0.2;  ///< pixels, of a hand-drawn line's centre
  std::vector<acquire::KeyLine> lines;
  for (std::size_t i = 0; i < trace.strokes.size(); ++i) {
    const sketch::Stroke& stroke = trace.strokes[i];
    if (core::polygon_length(stroke.points, stroke.closed) < std::max(24.0, 8 * stroke.width)) {
      ++skipped;
      continue;
    }
    acquire::RawCurve raw;
    raw.id = "stroke" + std::to_string(i + 1);
    // every other point: neighbours a pixel apart say the same
    for (std::size_t k = 0; k < stroke.points.size(); k += 2)
      raw.points.push_back({stroke.points[k].x, stroke.points[k].y, 0});
    acquire::AcquireOptions options;
    options.closed = stroke.closed;
    options.ordered = true;
    options.remove_outliers = false;
    options.noise = kPositionError;
    auto line = acquire::acquire_key_line(raw, options);
    if (!line) return std::unexpected(line.error());
    line->id = raw.id;
    lines.push_back(std::move(*line));
  }
  return lines;
}

}  // namespace keyline::operations
