#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/image_reader.h"
#include "keyline/exchange/scap_reader.h"
#include "keyline/operations/sketch_run.h"

#include "commands.h"
#include "output.h"
#include "sketch_debug.h"
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

/// The command's options as a request, so that the operation's checks hold for both doors.
Result<sketch::TraceOptions> options_of(const SketchCommand& command) {
  nlohmann::json request = {{"edge", command.edge},
                            {"consolidate", command.consolidate},
                            {"curvature", command.curvature},
                            {"flatten", command.flatten},
                            {"polarity", command.polarity}};
  const auto set = [&](const char* name, const auto& value) {
    if (value) request[name] = *value;
  };
  set("threshold", command.threshold);
  set("log_gain", command.gain);
  set("gap", command.gap);
  set("specks", command.specks);
  set("tolerance", command.common.tolerance);
  if (command.per_segment) request["tolerance"] = 0;
  if (!command.thresholds.empty()) {
    for (const std::string& text : command.thresholds) {
      nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
      request["thresholds"].push_back(text == "auto" ? nlohmann::json() : std::move(value));
    }
  }
  return operations::trace_options(request);
}

/// A document's curves as strokes, sampled finely; width of the pen from the first that has one.
std::vector<sketch::DrawnStroke> strokes_of(const document::Document& document, double& pen) {
  std::vector<sketch::DrawnStroke> strokes;
  for (const document::NamedPath& named : document.paths) {
    if (pen <= 0) pen = named.stroke_width;
    sketch::DrawnStroke stroke{{}, named.path.closed};
    const int samples = 64 * std::max(1, static_cast<int>(named.path.curves.size()));
    for (int i = 0; i <= samples; ++i) {
      const core::Point2 p = evaluate(named.path, static_cast<double>(i) / samples);
      if (stroke.points.empty() || stroke.points.back() != p) stroke.points.push_back(p);
    }
    if (stroke.closed && stroke.points.size() > 1 && stroke.points.front() == stroke.points.back())
      stroke.points.pop_back();
    if (stroke.points.size() > 1) strokes.push_back(std::move(stroke));
  }
  if (pen <= 0) pen = exchange::extent(document) / 400;
  return strokes;
}

Result<sketch::TraceResult> trace_vectors(const std::string& file,
                                          const sketch::TraceOptions& options) {
  if (exchange::extension_of(file) != ".scap") {
    const auto document = exchange::read_document(file);
    if (!document) return std::unexpected(document.error());
    double pen = 0;
    const auto strokes = strokes_of(*document, pen);
    return operations::trace_drawn(strokes, pen, options);
  }
  const auto text = exchange::read_file(file);
  if (!text) return std::unexpected(text.error());
  const auto drawing = exchange::read_scap(*text);
  if (!drawing) return std::unexpected(exchange::in_file(drawing.error(), file));
  std::vector<sketch::DrawnStroke> strokes;
  for (const exchange::ScapStroke& s : drawing->strokes) {
    sketch::DrawnStroke stroke;
    for (const core::Point2 p : s.points) stroke.points.push_back({p.x, drawing->height - p.y});
    if (stroke.points.size() > 1) strokes.push_back(std::move(stroke));
  }
  return operations::trace_drawn(strokes, drawing->pen, options);
}

Result<Sketch> trace_file(const SketchCommand& command) {
  auto options = options_of(command);
  if (!options) return std::unexpected(options.error());
  Sketch sketch;
  if (command.scale) sketch.scale = *command.scale;
  if (command.dpi) sketch.scale = 25.4 / *command.dpi;
  if (command.scale || command.dpi) sketch.unit = "mm";
  const std::string extension = exchange::extension_of(command.file);
  const bool vectors =
      extension == ".scap" || extension == ".svg" || extension == ".json" || extension == ".dxf";
  SketchDebug debug;
  if (!command.debug.empty()) options->stage = [&](const sketch::Stage& s) { debug.add(s); };
  options->progress = interactive_progress(command.common.quiet);
  Result<sketch::TraceResult> trace = core::fail(core::ErrorCode::internal, "");
  if (vectors) {
    trace = trace_vectors(command.file, *options);
  } else {
    auto image = exchange::read_image_file(command.file);
    if (!image) return std::unexpected(image.error());
    trace = operations::trace_picture(std::move(*image), *options);
  }
  end_progress();
  if (!trace) return std::unexpected(trace.error());
  if (!command.debug.empty())
    if (auto done = debug.write(command.debug, *trace); !done) return std::unexpected(done.error());
  sketch.trace = std::move(*trace);
  return sketch;
}

/// On the picture's page and in its own coordinates (y down from its upper edge), so that drawing
/// and curves lie on each other.
Result<std::string> write_svg(const Sketch& sketch, double tolerance) {
  const double height = sketch.scale * sketch.trace.height;
  document::Document document = operations::sketch_document(sketch.trace, sketch.scale, -height);
  document.unit = sketch.unit;
  if (height > 0) document.page = curve::Box2{{0, -height}, {sketch.scale * sketch.trace.width, 0}};
  auto written = exchange::format_document(document, ".svg", {.tolerance = tolerance});
  if (!written) return std::unexpected(written.error());
  return std::move(written->content);
}

/// What driving the curvature reached, over all strokes.
std::string drive_note(const Sketch& sketch) {
  double before = 0;
  double after = 0;
  double count = 0;
  for (const sketch::Stroke& stroke : sketch.trace.strokes) {
    if (!stroke.driven) continue;
    const auto n = static_cast<double>(stroke.target.size());
    before += n * stroke.driven->before * stroke.driven->before;
    after += n * stroke.driven->after * stroke.driven->after;
    count += n;
  }
  if (count == 0) return {};
  const double unit = std::sqrt(1 / count) / sketch.scale;
  return fmt::format("curvature off its target by {:.3g} 1/{} (root mean square), {:.3g} before",
                     unit * std::sqrt(after), sketch.unit, unit * std::sqrt(before));
}

void tell(const Sketch& sketch, const SketchCommand& command) {
  std::size_t pieces = 0;
  std::size_t segments = 0;
  for (const sketch::Stroke& stroke : sketch.trace.strokes) {
    pieces += stroke.curve.size();
    segments += stroke.segments.size() - (stroke.closed ? 0 : 1);
  }
  for (const std::string& note : sketch.trace.notes) say(command.common.quiet, note);
  const std::string size =
      sketch.trace.width > 0
          ? fmt::format("{} x {} pixels, ", sketch.trace.width, sketch.trace.height)
          : "";
  say(command.common.quiet,
      fmt::format("{}{}: {}, {}", size, core::counted(sketch.trace.strokes.size(), "stroke"),
                  core::counted(segments, "line segment"), core::counted(pieces, "quintic")));
  if (const std::string note = drive_note(sketch); !note.empty()) say(command.common.quiet, note);
}

}  // namespace

int run_sketch(const SketchCommand& command) {
  if (auto known = check_outputs(command.common, curve_extensions({".pdf", ".png", ".html"}),
                                 {command.file});
      !known)
    return report_failure(known.error());
  const auto sketch = trace_file(command);
  if (!sketch)
    return report_failure(sketch.error(), sketch.error().path.empty() ? command.file : "");
  const double tolerance = 0.02 * sketch->scale;
  document::Document document = operations::sketch_document(sketch->trace, sketch->scale, 0);
  document.unit = sketch->unit;
  Writers writers = curve_writers(document, tolerance, command.common);
  writers[".svg"] = [&] { return write_svg(*sketch, tolerance); };
  add_picture_writers(writers, document, "Traced drawing", command.file, command.common);
  if (auto done = write_outputs(command.common, writers); !done)
    return report_failure(done.error());
  if (command.common.json) {
    nlohmann::json result = operations::sketch_json(sketch->trace, sketch->scale);
    result["unit"] = sketch->unit;
    fmt::print("{}\n", result.dump());
  }
  tell(*sketch, command);
  return kDone;
}

}  // namespace keyline::app
