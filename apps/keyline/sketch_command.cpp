#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/exchange/document_file.h"
#include "keyline/exchange/image_reader.h"
#include "keyline/exchange/json_curve.h"
#include "keyline/sketch/trace.h"

#include "commands.h"
#include "input.h"
#include "output.h"
#include "terminal.h"

namespace keyline::app {
namespace {

using core::Result;

/// What was traced, in the unit it is written in: pixels, or mm by --scale or --dpi.
struct Sketch {
  sketch::TraceResult trace;
  double scale = 1;
  std::string unit = "px";
};

document::Path path_of(const sketch::Stroke& stroke, const core::Similarity2& map) {
  document::Path path;
  path.closed = stroke.closed;
  for (const curve::Bezier2& piece : stroke.curve)
    path.curves.push_back({curve::transform(piece, map)});
  return path;
}

/// The strokes in the output's unit, moved up by `lift`.
document::Document document_of(const Sketch& sketch, double lift) {
  document::Document document;
  document.unit = sketch.unit;
  const core::Similarity2 map{sketch.scale, 0, {0, lift}};
  for (std::size_t i = 0; i < sketch.trace.strokes.size(); ++i) {
    const sketch::Stroke& stroke = sketch.trace.strokes[i];
    document.paths.push_back({{"stroke" + std::to_string(i + 1), {}, {}},
                              path_of(stroke, map),
                              sketch.scale * stroke.width});
  }
  return document;
}

/// On the picture's page and in its own coordinates (y down from its upper edge), so that drawing
/// and curves lie on each other.
Result<std::string> write_svg(const Sketch& sketch, double tolerance) {
  const double height = sketch.scale * sketch.trace.height;
  document::Document document = document_of(sketch, -height);
  document.page = curve::Box2{{0, -height}, {sketch.scale * sketch.trace.width, 0}};
  auto written = exchange::format_document(document, ".svg", {.tolerance = tolerance});
  if (!written) return std::unexpected(written.error());
  return std::move(written->content);
}

nlohmann::json points_json(const std::vector<core::Point2>& points, double scale) {
  nlohmann::json list = nlohmann::json::array();
  for (const core::Point2 p : points) list.push_back({scale * p.x, scale * p.y});
  return list;
}

nlohmann::json result_json(const Sketch& sketch) {
  nlohmann::json strokes = nlohmann::json::array();
  for (const sketch::Stroke& stroke : sketch.trace.strokes)
    strokes.push_back({{"points", points_json(stroke.points, sketch.scale)},
                       {"segments", points_json(stroke.segments, sketch.scale)},
                       {"curve", exchange::to_json(path_of(stroke, {sketch.scale, 0, {}}))},
                       {"closed", stroke.closed},
                       {"width", sketch.scale * stroke.width}});
  return {{"strokes", std::move(strokes)}, {"unit", sketch.unit}};
}

Result<Sketch> trace_file(const SketchCommand& command) {
  auto image = exchange::read_image_file(command.file);
  if (!image) return std::unexpected(image.error());
  Sketch sketch;
  if (command.scale) sketch.scale = *command.scale;
  if (command.dpi) sketch.scale = 25.4 / *command.dpi;
  if (command.scale || command.dpi) sketch.unit = "mm";
  sketch::TraceOptions options;
  options.tone.gain = command.gain;
  options.binarize.threshold = command.threshold;
  options.gap = command.gap;
  options.specks = command.specks;
  options.progress = interactive_progress(command.common.quiet);
  auto trace = sketch::trace(std::move(*image), options);
  end_progress();
  if (!trace) return std::unexpected(trace.error());
  sketch.trace = std::move(*trace);
  return sketch;
}

}  // namespace

int run_sketch(const SketchCommand& command) {
  if (auto known = check_outputs(command.common, curve_extensions()); !known)
    return report_failure(known.error());
  const auto sketch = trace_file(command);
  if (!sketch)
    return report_failure(sketch.error(), sketch.error().path.empty() ? command.file : "");
  const double tolerance = 0.02 * sketch->scale;
  Writers writers = curve_writers(document_of(*sketch, 0), tolerance, command.common);
  writers[".svg"] = [&] { return write_svg(*sketch, tolerance); };
  if (auto done = write_outputs(command.common, writers); !done)
    return report_failure(done.error());
  if (command.common.json) fmt::print("{}\n", result_json(*sketch).dump());
  std::size_t pieces = 0;
  for (const sketch::Stroke& stroke : sketch->trace.strokes) pieces += stroke.curve.size();
  for (const std::string& note : sketch->trace.notes) say(command.common.quiet, note);
  say(command.common.quiet,
      fmt::format("{} x {} pixels, {} strokes in {} quintics", sketch->trace.width,
                  sketch->trace.height, sketch->trace.strokes.size(), pieces));
  return kDone;
}

}  // namespace keyline::app
