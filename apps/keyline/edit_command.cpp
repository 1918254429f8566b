#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/exchange/json_curve.h"
#include "keyline/figure/drawing.h"
#include "keyline/operations/class_a_figure.h"
#include "keyline/operations/curve_edit.h"
#include "keyline/operations/fair_report.h"
#include "keyline/operations/perform.h"
#include "keyline/report/html_report.h"

#include "commands.h"
#include "output.h"
#include "reading.h"
#include "surface_commands.h"
#include "terminal.h"
#include "typed.h"

namespace keyline::app {
namespace {

using core::Result;
using nlohmann::json;

/// One curve of the file and what became of it.
struct Edited {
  std::string name;
  classa::Approximation given;
  classa::EditResult result;
  json shown;
};

/// The options in the words of operation curve.edit.
json request_of(const EditCommand& command) {
  json request = json::object();
  if (command.common.tolerance) request["fit_tolerance"] = *command.common.tolerance;
  request["amount"] = command.amount;
  request["direction"] = command.direction;
  request["branch"] = command.branch;
  request["hold"] = command.hold;
  if (command.alpha_max) request["alpha_max"] = *command.alpha_max;
  if (command.end_tolerance) request["end_tolerance"] = *command.end_tolerance;
  if (!command.alpha_range.empty()) request["alpha_range"] = command.alpha_range;
  if (!command.s_range.empty()) request["s_range"] = command.s_range;
  if (command.to.size() == 2) request["target"] = {{"alpha", command.to[0]}, {"s", command.to[1]}};
  return request;
}

Result<Edited> edit_path(const document::NamedPath& named, json request) {
  request["curve"] = exchange::to_json(named.path);
  const auto outcome = operations::carry_out("curve.edit", request, {});
  if (!outcome) return std::unexpected(outcome.error());
  auto shown = operations::result_json(*outcome);
  if (!shown) return std::unexpected(shown.error());
  const auto& answer = *outcome->result_as<operations::CurveEditAnswer>();
  return Edited{named.label.name, *answer.given, *answer.edited, std::move(*shown)};
}

std::string place_text(const classa::CurveValue& v) {
  return v.matrix ? fmt::format("{:.6g} {:.6g}", v.matrix->alpha, v.matrix->s) : "-";
}

void print_summary(const Edited& e) {
  if (!e.name.empty()) fmt::print("{}\n", e.name);
  if (!e.given.exact)
    fmt::print("approximated by degree {} within {:.4g}\n", curve::degree(e.given.curve),
               e.given.deviation);
  fmt::print("{:>8} {:>5} {:>11} {:>21} {:>11} {:>10}\n", "", "type", "CAV", "alpha, s", "energy",
             "monotone");
  for (const auto& [word, value] :
       {std::pair{"before", &e.result.before}, std::pair{"after", &e.result.after}})
    fmt::print("{:>8} {:>5} {:>11.6g} {:>21} {:>11.6g} {:>10}\n", word, value->type, value->cav,
               place_text(*value), value->energy,
               core::word_of(operations::verdict_of(value->monotone.answer)));
}

operations::ReportOptions report_options(const EditCommand& command, const std::string& name) {
  operations::ReportOptions options;
  options.title = name.empty() ? "Edited curve" : "Edited curve: " + name;
  options.subtitle = command.input.files.front();
  options.unit = command.input.unit;
  options.command = command.common.command_line;
  options.generator = "Keyline " KEYLINE_VERSION;
  return options;
}

void add_pictures(Writers& writers, const EditCommand& command, const std::vector<Edited>& all,
                  const classa::EditOptions& options) {
  writers[".html"] = [&]() -> Result<std::string> {
    std::vector<report::Report> reports;
    for (const Edited& e : all)
      reports.push_back(
          operations::edit_report(e.result, e.given, options, report_options(command, e.name)));
    return report::html_report(operations::joined_report(reports, "Edited curves"));
  };
  const auto picture = [&] {
    std::vector<figure::Drawing> drawings;
    for (const Edited& e : all)
      drawings.push_back(
          operations::edit_picture(e.result, e.given, options, report_options(command, e.name)));
    return figure::tile(drawings, 1);
  };
  writers[".pdf"] = [picture] { return figure::write_pdf(picture()); };
  writers[".png"] = [picture] { return figure::write_png(picture(), 2); };
}

double size_of(const curve::Bezier2& c) {
  double size = 0;
  for (const core::Point2& p : c.control) size = std::max(size, distance(p, c.control.front()));
  return size;
}

}  // namespace

int run_edit(const EditCommand& command) {
  const CommonOptions& common = command.common;
  if (auto known =
          check_outputs(common, curve_extensions({".html", ".pdf", ".png"}), command.input.files);
      !known)
    return report_failure(known.error());
  const json request = request_of(command);
  const auto asked = from_json<operations::CurveEditRequest>(request, "curve.edit");
  if (!asked) return report_failure(asked.error());
  const classa::EditOptions options = operations::edit_options(*asked);
  const std::string& file = command.input.files.front();
  const auto read = read_files(command.input, interactive_progress(common.quiet));
  if (!read) return report_failure(read.error());
  end_progress();
  const document::Document* document = &read->document;
  if (!document->surfaces.empty()) return edit_surfaces(command, *document);
  if (document->paths.empty())
    return report_failure({core::ErrorCode::bad_input, "there is no planar curve or patch to edit",
                           "give a file that holds one", ""},
                          file);
  std::vector<Edited> all;
  document::Document curves;
  curves.unit = document->unit;
  json shown = json::array();
  double size = HUGE_VAL;
  for (const document::NamedPath& named : document->paths) {
    auto edited = edit_path(named, request);
    if (!edited) return report_failure(edited.error(), file);
    if (!common.json && !common.quiet) print_summary(*edited);
    size = std::min(size, size_of(edited->result.curve));
    curves.paths.push_back({named.label, {{{edited->result.curve}}, false}, named.stroke_width});
    if (!edited->name.empty()) edited->shown["name"] = edited->name;
    shown.push_back(edited->shown);
    all.push_back(std::move(*edited));
  }
  if (shown.size() == 1)
    shown = json(shown[0]);
  else
    shown = json{{"curves", shown}};
  Writers writers = curve_writers(curves, 1e-5 * size, common);
  add_pictures(writers, command, all, options);
  if (auto done = write_outputs(common, writers); !done) return report_failure(done.error());
  if (common.json) fmt::print("{}\n", shown.dump());
  return kDone;
}

}  // namespace keyline::app
