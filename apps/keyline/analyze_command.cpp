#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/exchange/json_curve.h"
#include "keyline/figure/drawing.h"
#include "keyline/operations/analyze_report.h"
#include "keyline/operations/class_a.h"
#include "keyline/operations/class_a_figure.h"
#include "keyline/operations/fair_report.h"
#include "keyline/operations/perform.h"
#include "keyline/operations/pictures.h"
#include "keyline/report/html_report.h"

#include "commands.h"
#include "output.h"
#include "reading.h"
#include "surface_commands.h"
#include "terminal.h"
#include "words.h"

namespace keyline::app {
namespace {

using core::Result;
using nlohmann::json;

struct Subject {
  std::string name;
  operations::AnalyzeAnswer answer;
  std::optional<classa::Evaluation> class_a = {};
  json shown = {};
  const document::Path& path() const { return answer.path; }
  const analysis::CurveAnalysis& analysis() const { return answer.analysis; }
};

/// The value of a curve that one Bezier curve stands for; in "class_a" of the result, or why not.
void add_class_a(Subject& subject, std::optional<double> tolerance) {
  json request{{"curve", exchange::to_json(subject.path())}};
  if (tolerance) request["fit_tolerance"] = *tolerance;
  const auto value = operations::carry_out("curve.cav", request, {});
  if (value) {
    subject.class_a = value->result_as<operations::EvaluationShown>()->evaluation;
    subject.shown["class_a"] = operations::result_json(*value).value();
  } else {
    subject.shown["class_a"] = {{"reason", value.error().message}};
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

Result<Subject> analyzed(const operations::NamedCurve& curve, const AnalyzeCommand& command,
                         const core::Progress& progress) {
  json request = subject_of(curve, command.input);
  request["seed"] = command.common.seed;
  const auto outcome =
      operations::carry_out("curve.analyze", request, {command.common.threads, progress});
  if (!outcome) return std::unexpected(as_options(outcome.error()));
  auto shown = operations::result_json(*outcome);
  if (!shown) return std::unexpected(shown.error());
  Subject subject{curve.name, *outcome->result_as<operations::AnalyzeAnswer>()};
  subject.shown = std::move(*shown);
  add_class_a(subject, command.common.tolerance);
  return subject;
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
  options.options = {
      {"noise",
       fmt::format("{:.4g}", subject.answer.noise.value_or(command.input.noise.value_or(0)))},
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
      reports.push_back(operations::analyze_report(subject.analysis(), subject.path(),
                                                   report_options(command, subject)));
      if (subject.class_a)
        reports.back().sections.push_back(operations::class_a_section(places, place++, {}));
    }
    return report::html_report(operations::joined_report(reports, "Curve analysis"));
  };
  const auto picture = [&] {
    std::vector<figure::Drawing> drawings;
    for (const Subject& subject : subjects) {
      drawings.push_back(operations::analyze_picture(subject.analysis(), subject.path(),
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

/// Every curve of the input.
Result<std::vector<Subject>> analyze_all(const AnalyzeCommand& command,
                                         const operations::ReadAnswer& read) {
  const core::Progress progress = interactive_progress(command.common.quiet);
  std::vector<Subject> subjects;
  for (const operations::NamedCurve& curve : read.curves) {
    if (!curve.line && !operations::planar_path(*curve.curve)) continue;
    auto subject = analyzed(curve, command, progress);
    if (!subject) return std::unexpected(subject.error());
    subjects.push_back(std::move(*subject));
  }
  end_progress();
  return subjects;
}

int analyze_curves(const AnalyzeCommand& command, const operations::ReadAnswer& read) {
  const CommonOptions& common = command.common;
  const auto subjects = analyze_all(command, read);
  if (!subjects) return report_failure(subjects.error(), command.input.files.front());
  json all = json::array();
  document::Document curves;
  curves.unit = command.input.unit;
  double size = HUGE_VAL;
  for (const Subject& subject : *subjects) {
    size = std::min(size, subject.analysis().length);
    curves.paths.push_back({{subject.name, {}, {}}, subject.path(), 0});
    if (!common.json && !common.quiet) print_summary(subject.name, subject.shown);
    all.push_back(subject.shown);
    if (!subject.name.empty()) all.back()["name"] = subject.name;
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
  const auto read = read_files(command.input, interactive_progress(command.common.quiet));
  if (!read) return report_failure(read.error());
  end_progress();
  if (!read->surfaces.empty()) return analyze_surfaces(command, read->document);
  for (const std::string& skipped : read->skipped) say(command.common.quiet, skipped);
  if (auto known = check_curve_outputs(command); !known) return report_failure(known.error());
  return analyze_curves(command, *read);
}

}  // namespace keyline::app
