#include "keyline/operations/surface_edit.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/operations/fair_report.h"
#include "keyline/operations/surface_conditions.h"
#include "keyline/operations/surface_pictures.h"
#include "keyline/report/html_report.h"

#include "output.h"
#include "surface_commands.h"
#include "terminal.h"

namespace keyline::app {
namespace {

using core::Result;
using nlohmann::json;

struct Edited {
  std::string name;
  surface::BezierSurface given;
  surface::EditResult result;
};

/// Conditions as surface.edit takes them: of every curve from the options curves share, then those
/// of --condition.
Result<json> conditions_of(const EditCommand& command) {
  json all = json::array();
  json general = json::object();
  if (!command.alpha_range.empty()) general["alpha"] = command.alpha_range;
  if (!command.s_range.empty()) general["s"] = command.s_range;
  if (command.branch != "own") general["branch"] = command.branch;
  if (!general.empty()) all.push_back(general);
  for (const std::string& text : command.conditions) {
    auto condition = operations::condition_from_text(text);
    if (!condition) return condition;
    all.push_back(std::move(*condition));
  }
  return all;
}

Result<json> request_of(const EditCommand& command) {
  json request{{"keep", command.keep}, {"amount", command.amount}};
  auto conditions = conditions_of(command);
  if (!conditions) return conditions;
  request["conditions"] = std::move(*conditions);
  if (command.limit) request["limit"] = *command.limit;
  if (command.alpha_max) request["alpha_max"] = *command.alpha_max;
  if (command.end_tolerance) request["end_tolerance"] = *command.end_tolerance;
  return request;
}

void print_summary(const Edited& e) {
  if (!e.name.empty()) fmt::print("{}\n", e.name);
  fmt::print("SAV {:.5g} to {:.5g}  departure {:.4g}  target {} ({:.3g} %)\n", e.result.before.sav,
             e.result.after.sav, e.result.departure, e.result.target, 100 * e.result.amount);
  fmt::print("{:>24} {:>11} {:>11}\n", "target", "departure", "SAV");
  for (const surface::TradeOff& t : e.result.tradeoff)
    fmt::print("{:>24} {:>11.5g} {:>11.5g}\n", t.name, t.departure, t.sav);
  for (const surface::MissedTarget& m : e.result.missed)
    fmt::print("{:>24} not found: {}, {}\n", m.target, m.curve, m.why);
  for (const surface::MissedTarget& m : e.result.unmet)
    fmt::print("short of the target {} is outside its condition: {}\n", m.curve, m.why);
}

operations::ReportOptions report_options(const EditCommand& command, const std::string& unit,
                                         const std::string& name) {
  operations::ReportOptions options;
  options.title = name.empty() ? "Edited surface" : "Edited surface: " + name;
  options.subtitle = command.input.files.front();
  options.unit = unit.empty() ? command.input.unit : unit;
  options.command = command.common.command_line;
  options.generator = "Keyline " KEYLINE_VERSION;
  options.options = {{"keep", command.keep}, {"amount", fmt::format("{:g}", command.amount)}};
  for (const std::string& c : command.conditions) options.options.push_back({"condition", c});
  return options;
}

Result<figure::Drawing> page_of(const EditCommand& command, const std::vector<Edited>& all,
                                const std::string& unit) {
  std::vector<figure::Drawing> pages;
  for (const Edited& e : all) {
    auto page =
        operations::surface_edit_page(e.given, e.result, report_options(command, unit, e.name));
    if (!page) return page;
    pages.push_back(std::move(*page));
  }
  return figure::stack(pages);
}

void add_pictures(Writers& writers, const EditCommand& command, const std::vector<Edited>& all,
                  const std::string& unit) {
  writers[".html"] = [&, unit]() -> Result<std::string> {
    std::vector<report::Report> reports;
    for (const Edited& e : all) {
      auto made =
          operations::surface_edit_report(e.given, e.result, report_options(command, unit, e.name));
      if (!made) return std::unexpected(made.error());
      reports.push_back(std::move(*made));
    }
    return report::html_report(operations::joined_report(reports, "Edited surfaces"));
  };
  const auto page = [&, unit] { return page_of(command, all, unit); };
  writers[".png"] = [page]() -> Result<std::string> {
    const auto d = page();
    if (!d) return std::unexpected(d.error());
    return figure::write_png(*d, 2);
  };
  writers[".pdf"] = [page]() -> Result<std::string> {
    const auto d = page();
    if (!d) return std::unexpected(d.error());
    return figure::write_pdf(*d);
  };
  writers[".svg"] = [page]() -> Result<std::string> {
    const auto d = page();
    if (!d) return std::unexpected(d.error());
    return figure::write_svg(*d);
  };
}

Result<Edited> edit_one(const document::NamedSurface& named, const surface::EditOptions& options) {
  auto patch = operations::one_patch(named.surface);
  if (!patch) return std::unexpected(patch.error());
  auto result = surface::edit(*patch, options);
  if (!result) return std::unexpected(result.error());
  return Edited{named.label.name, std::move(*patch), std::move(*result)};
}

}  // namespace

int edit_surfaces(const EditCommand& command, const document::Document& document) {
  const CommonOptions& common = command.common;
  const auto request = request_of(command);
  if (!request) return report_failure(request.error());
  auto options = operations::surface_edit_options(*request);
  if (!options) return report_failure(options.error());
  say_curves_left_out(document, common.quiet);
  std::vector<Edited> all;
  json shown = json::array();
  document::Document written;
  written.unit = document.unit;
  const core::Progress progress = interactive_progress(common.quiet);
  for (std::size_t i = 0; i < document.surfaces.size(); ++i) {
    const double count = static_cast<double>(document.surfaces.size());
    options->progress = core::part_of(progress, i / count, (i + 1) / count);
    auto edited = edit_one(document.surfaces[i], *options);
    if (!edited) {
      end_progress();
      return report_failure(edited.error(), command.input.files.front());
    }
    written.surfaces.push_back({document.surfaces[i].label, edited->result.surface, 0});
    shown.push_back(operations::surface_edit_json(edited->result));
    if (!edited->name.empty()) shown.back()["name"] = edited->name;
    all.push_back(std::move(*edited));
  }
  end_progress();
  if (!common.json && !common.quiet)
    for (const Edited& e : all) print_summary(e);
  Writers writers = curve_writers(written, common.tolerance.value_or(1e-6), common);
  add_pictures(writers, command, all, document.unit);
  if (auto done = write_outputs(common, writers); !done) return report_failure(done.error());
  if (common.json)
    fmt::print("{}\n", (shown.size() == 1 ? json(shown[0]) : json{{"surfaces", shown}}).dump());
  return kDone;
}

}  // namespace keyline::app
