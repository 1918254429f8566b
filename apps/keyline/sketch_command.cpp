#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "keyline/core/text.h"
#include "keyline/operations/sketch_trace.h"
#include "keyline/presentation/sketch_overlay.h"

#include "session.h"
#include "terminal.h"

namespace keyline::app {
namespace {

using core::Result;
using nlohmann::json;

constexpr std::size_t kTrace = 0;  // records of the command line
constexpr std::size_t kStages = 1;

struct LookingOn {
  std::string debug;
  std::string overlay;
  static constexpr auto describe() {
    return core::fields(
        core::field<&LookingOn::debug>("folder for a picture of every stage"),
        core::field<&LookingOn::overlay>("PNG of ink, numbered strokes and lines over each other"));
  }
  /// Fails: bad_input where the overlay is no .png.
  static Result<void> check(const LookingOn& look) {
    if (look.overlay.empty() || look.overlay.ends_with(".png")) return {};
    return core::fail(core::ErrorCode::bad_input, "overlays are PNG pictures",
                      "give a name that ends in .png", "overlay");
  }
};

Session new_session() {
  OptionGroup trace{
      "Tracing", operations::find_operation("sketch.trace")->request, {"file", "image", "stages"}};
  return Session({"sketch", "IMAGE ",
                  "A picture of a drawing (png, jpeg, tiff, webp) or pen strokes (scap, svg, dxf, "
                  "json) in, its lines as curves out.",
                  "Example: keyline sketch examples/sketch.png -o sketch.svg\n"
                  "Formats: svg, json (the exact quintics), csv (samples), dxf and what convert "
                  "writes.",
                  operations::further_options(*operations::find_operation("sketch.trace"))},
                 {trace, {"Looking on", &core::type_of<LookingOn>()}, door_group()});
}

/// What driving the curvature reached, over all strokes.
std::string drive_note(const operations::SketchAnswer& answer) {
  double before = 0;
  double after = 0;
  double count = 0;
  for (std::size_t i = 0; i < answer.strokes.size(); ++i) {
    const auto& error = answer.strokes[i].curvature_error;
    if (!error) continue;
    const auto n = static_cast<double>(answer.trace.strokes[i].target.size());
    before += n * error->before * error->before;
    after += n * error->after * error->after;
    count += n;
  }
  if (count == 0) return {};
  return fmt::format("curvature off its target by {:.3g} 1/{} (root mean square), {:.3g} before",
                     std::sqrt(after / count), answer.unit, std::sqrt(before / count));
}

void tell(const operations::SketchAnswer& answer, bool quiet) {
  std::size_t pieces = 0;
  std::size_t segments = 0;
  for (const auto& stroke : answer.trace.strokes) {
    pieces += stroke.curve.size();
    segments += stroke.segments.size() - (stroke.closed ? 0 : 1);
  }
  for (const std::string& note : answer.report) say(quiet, note);
  const std::string size =
      answer.trace.width > 0
          ? fmt::format("{} x {} pixels, ", answer.trace.width, answer.trace.height)
          : "";
  say(quiet,
      fmt::format("{}{}: {}, {}", size, core::counted(answer.strokes.size(), "stroke"),
                  core::counted(segments, "line segment"), core::counted(pieces, "quintic")));
  if (const std::string note = drive_note(answer); !note.empty()) say(quiet, note);
}

/// A request of document.write: on the picture's page, so that drawing and curves lie on each
/// other.
json document_of(const json& result) {
  json document{{"unit", result["unit"]}, {"curves", json::array()}};
  for (const json& stroke : result["strokes"])
    document["curves"].push_back({{"name", fmt::format("stroke{}", document["curves"].size() + 1)},
                                  {"curve", stroke["curve"]},
                                  {"stroke_width", stroke["width"]}});
  if (result["size"][1] > 0) {
    document["page"] = {{"low", {0, 0}}, {"high", result["size"]}};
    document["on_page"] = true;
  }
  return document;
}

Result<void> write_pictures(const operations::Outcome& outcome, const LookingOn& look) {
  if (!look.debug.empty()) {
    const auto pictures = presentation::stage_pictures(outcome);
    if (!pictures) return std::unexpected(pictures.error());
    if (auto done = presentation::write_folder(look.debug, *pictures); !done) return done;
  }
  if (look.overlay.empty()) return {};
  const auto picture = presentation::overlay_picture(outcome);
  if (!picture) return std::unexpected(picture.error());
  const std::filesystem::path file = look.overlay;
  return presentation::write_folder(file.has_parent_path() ? file.parent_path().string() : ".",
                                    {{file.filename().string(), *picture}});
}

Result<operations::Outcome> traced(Session& session, const LookingOn& look) {
  if (session.files().size() != 1)
    return core::fail(core::ErrorCode::bad_input, "one drawing is wanted", session.usage_hint());
  json request = session.of(kTrace);
  request["file"] = session.files().front();
  if (session.door().tolerance) request["tolerance"] = *session.door().tolerance;
  if (!look.debug.empty() || !look.overlay.empty()) request["stages"] = true;
  auto outcome = session.perform("sketch.trace", request, session.progress());
  end_progress();
  return outcome;
}

}  // namespace

int run_sketch(const Words& words) {
  Session session = new_session();
  if (const auto status = session.begin(words)) return *status;
  if (auto done = session.check_outputs(); !done) return report_failure(done.error());
  const auto look = session.record<LookingOn>(kStages);
  if (!look) return report_failure(look.error());
  const auto outcome = traced(session, *look);
  if (!outcome)
    return report_failure(outcome.error(),
                          outcome.error().path.empty() ? session.files().front() : "");
  if (auto done = write_pictures(*outcome, *look); !done) return report_failure(done.error());
  auto result = shown_of(*outcome);
  if (!result) return report_failure(result.error());
  result->erase("stages");  // they are in the pictures
  json document = document_of(*result);
  const auto output = presentation::output_of(document);
  if (!output) return report_failure(output.error());
  presentation::ReportOptions options = session.report_options();
  options.title = "Traced drawing";
  auto written = session.write(presentation::document_pages(output->document, options), *output);
  if (!written) return report_failure(written.error());
  session.print(*result, "");
  tell(*outcome->result_as<operations::SketchAnswer>(), session.door().quiet);
  return kDone;
}

Manual sketch_manual() { return new_session().manual(); }

}  // namespace keyline::app
