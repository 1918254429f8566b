#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"
#include "keyline/exchange/document_file.h"
#include "keyline/operations/sketch_run.h"
#include "keyline/operations/sketch_trace.h"

#include "commands.h"
#include "output.h"
#include "sketch_debug.h"
#include "terminal.h"
#include "typed.h"
#include "words.h"

namespace keyline::app {
namespace {

using core::Result;

/// What was traced, in the unit it is written in: pixels, or mm by --scale or --dpi.
struct Sketch {
  operations::SketchAnswer answer;
  sketch::TraceResult trace;
  double scale = 1;
  std::string unit = "px";
};

/// The command's options as a request, so that the operation's checks hold for both doors.
Result<operations::SketchRequest> request_of(const SketchCommand& command) {
  nlohmann::json request = {{"file", command.file},
                            {"edge", command.edge},
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
  set("scale", command.scale);
  set("dpi", command.dpi);
  return from_json<operations::SketchRequest>(request, "sketch.trace");
}

Result<Sketch> trace_file(const SketchCommand& command) {
  const auto request = request_of(command);
  if (!request) return std::unexpected(request.error());
  SketchDebug debug;
  std::function<void(const sketch::Stage&)> stage;
  if (!command.debug.empty()) stage = [&](const sketch::Stage& s) { debug.add(s); };
  auto trace = operations::trace_drawing(*request, interactive_progress(command.common.quiet),
                                         std::move(stage));
  end_progress();
  if (!trace) return std::unexpected(trace.error());
  if (!command.debug.empty())
    if (auto done = debug.write(command.debug, *trace); !done) return std::unexpected(done.error());
  Sketch sketch;
  sketch.scale = operations::scale_of(*request);
  sketch.answer = operations::sketch_answer(*request, *trace);
  sketch.unit = sketch.answer.unit;
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
    return report_failure(as_options(sketch.error()),
                          sketch.error().path.empty() ? command.file : "");
  const double tolerance = 0.02 * sketch->scale;
  document::Document document = operations::sketch_document(sketch->trace, sketch->scale, 0);
  document.unit = sketch->unit;
  Writers writers = curve_writers(document, tolerance, command.common);
  writers[".svg"] = [&] { return write_svg(*sketch, tolerance); };
  add_picture_writers(writers, document, "Traced drawing", command.file, command.common);
  if (auto done = write_outputs(command.common, writers); !done)
    return report_failure(done.error());
  if (command.common.json) {
    fmt::print("{}\n", to_json(sketch->answer).dump());
  }
  tell(*sketch, command);
  return kDone;
}

}  // namespace keyline::app
