#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/exchange/document_file.h"
#include "keyline/exchange/planar_form.h"
#include "keyline/figure/drawing.h"
#include "keyline/fit/fit_spline.h"
#include "keyline/operations/analysis_json.h"
#include "keyline/operations/analyze_report.h"
#include "keyline/operations/class_a_figure.h"
#include "keyline/operations/class_a_json.h"
#include "keyline/operations/class_a_request.h"
#include "keyline/operations/fair_report.h"
#include "keyline/operations/pictures.h"
#include "keyline/report/html_report.h"

#include "commands.h"
#include "input.h"
#include "output.h"
#include "surface_commands.h"
#include "terminal.h"

namespace keyline::app {
namespace {

using core::Result;
using nlohmann::json;

struct Subject {
  std::string name;
  document::Path path;
  double noise = 0;
  analysis::CurveAnalysis analysis = {};
  std::optional<classa::Evaluation> class_a = {};
};

/// The value of a curve that one Bezier curve stands for; in "class_a" of the result, or why not.
void add_class_a(Subject& subject, std::optional<double> tolerance, json& result) {
  auto bezier = operations::class_a_bezier(subject.path, tolerance);
  auto value = bezier ? classa::evaluate_curve(std::move(*bezier), {})
                      : Result<classa::Evaluation>(std::unexpected(bezier.error()));
  if (value) {
    result["class_a"] = operations::evaluation_json(*value);
    subject.class_a = std::move(*value);
  } else {
    result["class_a"] = {{"reason", value.error().message}};
  }
}

void print_class_a(const json& value) {
  if (value.contains("reason")) {
    fmt::print("class A: none; {}\n", value["reason"].get<std::string>());
    return;
  }
  std::string line =
      fmt::format("class A: {}  CAV {:.6g}", operations::type_in_words(value["type"].get<int>()),
                  value["cav"].get<double>());
  if (value.contains("approximation"))
    line += fmt::format("  (degree {} within {:.3g})", value["degree"].get<int>(),
                        value["approximation"]["deviation"].get<double>());
  if (value.contains("nearest") && value["nearest"].is_object()) {
    line += fmt::format("  nearest {:.3g} away", value["nearest"]["distance"].get<double>());
    if (value["nearest"]["cav"].is_number())
      line += fmt::format(", CAV {:.4g}", value["nearest"]["cav"].get<double>());
  }
  fmt::print("{}\n", line);
}

/// Points are analysed through their spline, as in steps 2 to 4 of fairing.
Result<Subject> spline_of(const acquire::KeyLine& line, const CommonOptions& common,
                          const core::Progress& progress) {
  fit::SplineFitOptions options = fit::SplineFitOptions::for_fairing();
  options.seed = static_cast<std::uint64_t>(common.seed);
  options.threads = common.threads;
  options.closed = line.closed && line.points.size() > 8;
  options.order = std::min<int>(options.order, static_cast<int>(line.points.size()));
  options.rounding = line.rounding;
  options.progress = progress;
  auto fit = fit::fit_spline(line.points, line.weights, options);
  if (!fit) return std::unexpected(fit.error());
  Subject subject;
  subject.name = line.id;
  subject.noise = line.noise;
  subject.path.closed = line.closed;
  subject.path.curves.push_back({std::move(fit->curve)});
  return subject;
}

/// Whether the vertices are points of a curve (a hull's offsets, a digitised outline), as fairing
/// takes them, and not corners of a polygon: enough for a spline, and turning gently.
bool holds_points_of_a_curve(const curve::Polyline2& line) {
  constexpr std::size_t kFewest = 5;
  constexpr double kGentle = 0.8;  // radians per vertex
  double turning = 0;
  for (std::size_t i = 2; i < line.points.size(); ++i)
    turning += std::abs(core::angle_between(line.points[i - 1] - line.points[i - 2],
                                            line.points[i] - line.points[i - 1]));
  return line.points.size() >= kFewest &&
         turning < kGentle * static_cast<double>(line.points.size() - 2);
}

Result<std::vector<Subject>> subjects_of(const AnalyzeCommand& command,
                                         const document::Document& document) {
  std::vector<Subject> subjects;
  const core::Progress progress = interactive_progress(command.common.quiet);
  for (const auto& named : document.paths) {
    const auto* polyline = only_polyline(named.path);
    if (!polyline || !holds_points_of_a_curve(*polyline)) {
      subjects.push_back(
          {.name = named.label.name, .path = named.path, .noise = command.input.noise.value_or(0)});
      continue;
    }
    const auto line = key_line_of(named.path, command.input);
    if (!line) return std::unexpected(exchange::in_file(line.error(), command.input.files.front()));
    auto subject = spline_of(*line, command.common, progress);
    if (!subject) return std::unexpected(subject.error());
    subject->name = named.label.name;
    subjects.push_back(std::move(*subject));
  }
  end_progress();
  return subjects;
}

Result<std::vector<Subject>> subjects_of_points(const AnalyzeCommand& command) {
  std::vector<Subject> subjects;
  const core::Progress progress = interactive_progress(command.common.quiet);
  const auto lines = load_key_lines(command.input);
  if (!lines) return std::unexpected(lines.error());
  for (const acquire::KeyLine& line : *lines) {
    auto subject = spline_of(line, command.common, progress);
    if (!subject) return std::unexpected(subject.error());
    subjects.push_back(std::move(*subject));
  }
  end_progress();
  return subjects;
}

void print_summary(const std::string& name, const json& result) {
  if (!name.empty()) fmt::print("{}\n", name);
  fmt::print("length {:.8g}  curvature {:.6g} to {:.6g}  inflections {}  extrema {}  monotone {}\n",
             result["length"].get<double>(), result["curvature"]["min"].get<double>(),
             result["curvature"]["max"].get<double>(), result["inflections"].size(),
             result["extrema"].size(), result["monotone"].get<std::string>());
  fmt::print("{:>5} {:>11} {:>11} {:>14} {:>11} {:>11}  {}\n", "piece", "from", "length", "rhythm",
             "slope", "volume", "impression");
  int index = 0;
  for (const json& piece : result["pieces"]) {
    std::string slopes;
    for (const json& slope : piece["slopes"])
      slopes += fmt::format("{}{:.3g}", slopes.empty() ? "" : " ", slope.get<double>());
    fmt::print("{:>5} {:>11.5g} {:>11.5g} {:>14} {:>11} {:>11.4g}  {}\n", index++,
               piece["arc_length"][0].get<double>(), piece["length"].get<double>(),
               piece["rhythm"].get<std::string>(), slopes, piece["volume"].get<double>(),
               piece["impression"].get<std::string>());
  }
  print_class_a(result["class_a"]);
}

operations::ReportOptions report_options(const AnalyzeCommand& command, const Subject& subject) {
  operations::ReportOptions options;
  options.title = subject.name.empty() ? "Curve analysis" : "Curve analysis: " + subject.name;
  options.subtitle = command.input.files.front();
  options.unit = command.input.unit;
  options.command = command.common.command_line;
  options.generator = "Keyline " KEYLINE_VERSION;
  options.options = {{"noise", fmt::format("{:.4g}", subject.noise)},
                     {"seed", std::to_string(command.common.seed)}};
  return options;
}

void add_pictures(Writers& writers, const AnalyzeCommand& command,
                  const std::vector<Subject>& subjects) {
  writers[".html"] = [&]() -> Result<std::string> {
    std::vector<report::Report> reports;
    std::vector<operations::PlaneEntry> places;
    for (const Subject& subject : subjects)
      if (subject.class_a)
        places.push_back({subject.name.empty() ? "the curve" : subject.name, &*subject.class_a});
    std::size_t place = 0;
    for (const Subject& subject : subjects) {
      reports.push_back(operations::analyze_report(subject.analysis, subject.path,
                                                   report_options(command, subject)));
      if (subject.class_a)
        reports.back().sections.push_back(operations::class_a_section(places, place++, {}));
    }
    return report::html_report(operations::joined_report(reports, "Curve analysis"));
  };
  const auto picture = [&] {
    std::vector<figure::Drawing> drawings;
    for (const Subject& subject : subjects) {
      drawings.push_back(operations::analyze_picture(subject.analysis, subject.path,
                                                     report_options(command, subject)));
      if (subject.class_a)
        drawings.back() = figure::stack(
            {drawings.back(),
             operations::plane_chart(
                 {{subject.name.empty() ? "the curve" : subject.name, &*subject.class_a}}, {})});
    }
    return figure::tile(drawings, 1);
  };
  writers[".pdf"] = [picture] { return figure::write_pdf(picture()); };
  writers[".png"] = [picture] { return figure::write_png(picture(), 2); };
}

Result<void> check_curve_outputs(const AnalyzeCommand& command) {
  return check_outputs(command.common, curve_extensions({".html", ".pdf", ".png"}),
                       command.input.files);
}

int analyze_curves(const AnalyzeCommand& command, Result<std::vector<Subject>> subjects) {
  const CommonOptions& common = command.common;
  if (!subjects) return report_failure(subjects.error());
  json all = json::array();
  document::Document curves;
  curves.unit = command.input.unit;
  double size = HUGE_VAL;
  for (Subject& subject : *subjects) {
    auto found = operations::analyze_path(subject.path, subject.noise);
    if (!found) return report_failure(found.error(), command.input.files.front());
    subject.analysis = std::move(*found);
    json result = operations::curve_analysis_json(subject.analysis);
    add_class_a(subject, common.tolerance, result);
    size = std::min(size, subject.analysis.length);
    curves.paths.push_back({{subject.name, {}, {}}, subject.path, 0});
    if (!common.json && !common.quiet) print_summary(subject.name, result);
    if (!subject.name.empty()) result["name"] = subject.name;
    all.push_back(std::move(result));
  }
  const json shown = all.size() == 1 ? all[0] : json{{"curves", all}};
  Writers writers = curve_writers(curves, common.tolerance.value_or(1e-5 * size), common);
  writers[".json"] = [&]() -> Result<std::string> { return shown.dump(1) + "\n"; };
  add_pictures(writers, command, *subjects);
  if (auto done = write_outputs(common, writers); !done) return report_failure(done.error());
  if (common.json) fmt::print("{}\n", shown.dump());
  return kDone;
}

}  // namespace

int run_analyze(const AnalyzeCommand& command) {
  const bool points = holds_points(command.input.files.front());
  document::Document document;
  if (!points) {
    auto loaded = load_document(command.input);
    if (!loaded) return report_failure(loaded.error());
    document = std::move(*loaded);
    if (!document.surfaces.empty()) return analyze_surfaces(command, document);
    std::vector<std::string> notes;
    exchange::flatten(document, notes);
    for (const std::string& note : notes) say(command.common.quiet, note);
  }
  if (auto known = check_curve_outputs(command); !known) return report_failure(known.error());
  if (points) return analyze_curves(command, subjects_of_points(command));
  return analyze_curves(command, subjects_of(command, document));
}

}  // namespace keyline::app
