#include "surface_commands.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"
#include "keyline/operations/fair_report.h"
#include "keyline/operations/surface_pictures.h"
#include "keyline/operations/surface_value.h"
#include "keyline/report/html_report.h"

#include "output.h"
#include "terminal.h"
#include "typed.h"

namespace keyline::app {
namespace {

using core::Result;
using nlohmann::json;
using operations::SurfaceSubject;

constexpr std::size_t kMostReports = 12;

std::string name_of(const document::Document& document, std::size_t i) {
  const std::string& name = document.surfaces[i].label.name;
  return name.empty() ? fmt::format("surface {}", i + 1) : name;
}

/// The nearest curves of one matrix: of every patch, or of many patches of the worst alone.
void find_nearest(SurfaceSubject& subject, int threads, const core::Progress& progress) {
  constexpr std::size_t kMostPatches = 16;
  auto& values = subject.values;
  if (values.size() <= kMostPatches) {
    surface::add_nearest(subject.surface, values, {}, threads, progress);
    return;
  }
  const auto worst =
      std::max_element(values.begin(), values.end(),
                       [](const auto& a, const auto& b) { return a.value.sav < b.value.sav; });
  std::vector<surface::PatchValue> alone{*worst};
  surface::add_nearest(subject.surface, alone, {}, threads, progress);
  *worst = std::move(alone.front());
}

/// Value of a surface; one that has none (rational, say) says why instead.
Result<SurfaceSubject> valued(std::string name, const surface::Surface& s,
                              const AnalyzeCommand& command, const core::Progress& progress) {
  SurfaceSubject subject{std::move(name), s, {}, {}, 0};
  auto values =
      surface::sav_by_patch(s, {}, command.common.threads, core::part_of(progress, 0, 0.3));
  if (values) {
    subject.values = std::move(*values);
    find_nearest(subject, command.common.threads, core::part_of(progress, 0.3, 1));
    return subject;
  }
  if (values.error().code == core::ErrorCode::cancelled) return std::unexpected(values.error());
  subject.no_value = values.error().message;
  return subject;
}

json curvature_json(const surface::Surface& s) {
  const auto grid = surface::sample_grid(s, 65, 65, 0);
  json j = json::object();
  for (const auto& [name, kind] :
       {std::pair{"gaussian", surface::FieldKind::gaussian}, {"mean", surface::FieldKind::mean}}) {
    const auto field = surface::interrogate(grid, kind);
    j[name] = {{"min", field->range.low}, {"max", field->range.high}};
  }
  return j;
}

json result_of(const SurfaceSubject& subject) {
  json j = subject.values.empty() ? json{{"sav", nullptr}, {"no_value", subject.no_value}}
                                  : to_json(operations::shown(subject.values));
  j["name"] = subject.name;
  if (subject.trims > 0) j["trims"] = subject.trims;
  j["curvature"] = curvature_json(subject.surface);
  return j;
}

std::string text_of(const json& number) {
  return number.is_number() ? fmt::format("{:.5g}", number.get<double>()) : "-";
}

void print_curves(const json& curves) {
  const bool nearest = std::any_of(curves.begin(), curves.end(),
                                   [](const json& c) { return c.contains("nearest"); });
  fmt::print("{:>6} {:>5} {:>10} {:>9} {:>9} {:>9} {:>9} {:>11}{}\n", "curve", "type", "CAV",
             "alpha", "s", "least a", "least s", "energy",
             nearest ? fmt::format(" {:>12} {:>9}", "nearest away", "its CAV") : "");
  for (const json& c : curves) {
    const json least = c["minimum"].is_object() ? c["minimum"] : json::object();
    const std::string beside = c.contains("nearest")
                                   ? fmt::format(" {:>12} {:>9}", text_of(c["nearest"]["distance"]),
                                                 text_of(c["nearest"]["cav"]))
                                   : "";
    fmt::print("{:>6} {:>5} {:>10} {:>9} {:>9} {:>9} {:>9} {:>11}{}\n",
               c["name"].get<std::string>(), c["type"].get<int>(), text_of(c["cav"]),
               text_of(c["alpha"]), text_of(c["s"]), text_of(least.value("alpha", json())),
               text_of(least.value("s", json())), text_of(c["energy"]), beside);
  }
}

void print_patches(const json& patches) {
  fmt::print("{:>8} {:>10} {:>6} {:>11}\n", "patch", "SAV", "worst", "of nearest");
  for (const json& p : patches)
    fmt::print("{:>8} {:>10} {:>6} {:>11}\n",
               fmt::format("{},{}", p["patch"][0].get<int>(), p["patch"][1].get<int>()),
               text_of(p["sav"]), p["worst"].get<std::string>(),
               text_of(p.value("nearest_sav", json())));
}

void print_summary(const json& result) {
  const json& k = result["curvature"];
  fmt::print("{}\n", result["name"].get<std::string>());
  if (result.contains("trims"))
    fmt::print("whole surface; {} edges cut a face out of it in the file\n",
               result["trims"].get<int>());
  fmt::print("Gaussian curvature {} to {}  mean curvature {} to {}\n",
             text_of(k["gaussian"]["min"]), text_of(k["gaussian"]["max"]),
             text_of(k["mean"]["min"]), text_of(k["mean"]["max"]));
  if (!result["sav"].is_number()) {
    fmt::print("no SAV: {}\n", result["no_value"].get<std::string>());
    return;
  }
  const std::string where =
      result.contains("worst_patch")
          ? fmt::format(" of patch {},{}", result["worst_patch"][0].get<int>(),
                        result["worst_patch"][1].get<int>())
          : "";
  const std::string nearest =
      result.contains("nearest_sav")
          ? fmt::format("  of the nearest curves {}", text_of(result["nearest_sav"]))
          : "";
  fmt::print("SAV {}{}  worst curve {}{}\n", text_of(result["sav"]), nearest,
             result["worst"].get<std::string>(), where);
  if (result.contains("patches"))
    print_patches(result["patches"]);
  else
    print_curves(result["curves"]);
}

operations::ReportOptions report_options(const AnalyzeCommand& command,
                                         const document::Document& document) {
  operations::ReportOptions options;
  options.subtitle = command.input.files.front();
  options.unit = document.unit.empty() ? command.input.unit : document.unit;
  options.command = command.common.command_line;
  options.generator = "Keyline " KEYLINE_VERSION;
  return options;
}

double sav_of(const SurfaceSubject& s) {
  double sum = 0;
  for (const auto& p : s.values) sum += p.value.sav;
  return sum;
}

Result<std::optional<surface::FieldKind>> shot_named(const std::string& name) {
  if (name == "lit") return std::nullopt;
  const auto kind = surface::field_named(name);
  if (kind) return kind;
  return core::fail(core::ErrorCode::bad_input, "\"" + name + "\" is no picture of a surface",
                    "use lit, zebra, gaussian, mean, principal, isophote, reflection or highlight",
                    "--show");
}

Result<operations::SurfaceLook> look_of(const AnalyzeCommand& command) {
  operations::SurfaceLook look;
  if (!command.show.empty()) look.shots.clear();
  for (const std::string& name : command.show) {
    const auto shot = shot_named(name);
    if (!shot) return std::unexpected(shot.error());
    look.shots.push_back(*shot);
  }
  look.stripe_count = command.stripes;
  if (command.view.size() == 3) {
    const core::Vector3 view{command.view[0], command.view[1], command.view[2]};
    if (!core::is_finite(view) || !(norm(view) > 0))
      return core::fail(core::ErrorCode::bad_input, "the view has no direction",
                        "give x,y,z not all 0", "--view");
    look.view = view;
    look.lighting.view = view;
  }
  return look;
}

Result<std::string> html_of(std::vector<SurfaceSubject> subjects,
                            const operations::ReportOptions& options,
                            const operations::SurfaceLook& look) {
  std::stable_sort(subjects.begin(), subjects.end(),
                   [](const auto& a, const auto& b) { return sav_of(a) > sav_of(b); });
  std::vector<report::Report> reports;
  for (const SurfaceSubject& subject : subjects) {
    if (reports.size() == kMostReports) break;
    auto made = operations::surface_report(subject, options, look);
    if (!made) return std::unexpected(made.error());
    reports.push_back(std::move(*made));
  }
  report::Report whole = operations::joined_report(reports, "Surface analysis");
  if (subjects.size() > kMostReports)
    whole.notes.push_back(
        {report::NoteKind::note, fmt::format("The {} surfaces of largest SAV out of {} are shown.",
                                             kMostReports, subjects.size())});
  return report::html_report(whole);
}

void add_pictures(Writers& writers, const std::vector<SurfaceSubject>& subjects,
                  const operations::ReportOptions& options, const operations::SurfaceLook& look) {
  writers[".html"] = [&] { return html_of(subjects, options, look); };
  const auto page = [&] { return operations::surface_page(subjects, options, look); };
  writers[".png"] = [page]() -> Result<std::string> {
    const auto drawing = page();
    if (!drawing) return std::unexpected(drawing.error());
    return figure::write_png(*drawing, 2);
  };
  writers[".pdf"] = [page]() -> Result<std::string> {
    const auto drawing = page();
    if (!drawing) return std::unexpected(drawing.error());
    return figure::write_pdf(*drawing);
  };
  writers[".svg"] = [page]() -> Result<std::string> {
    const auto drawing = page();
    if (!drawing) return std::unexpected(drawing.error());
    return figure::write_svg(*drawing);
  };
}

}  // namespace

void say_curves_left_out(const document::Document& document, bool quiet) {
  const std::size_t curves = document.paths.size() + document.space_curves.size();
  if (curves == 0) return;
  say(quiet, fmt::format("{} of the file left out beside its surfaces; --select takes one",
                         core::counted(curves, "curve")));
}

int analyze_surfaces(const AnalyzeCommand& command, const document::Document& document) {
  const CommonOptions& common = command.common;
  if (auto known =
          check_outputs(common, {".json", ".html", ".png", ".pdf", ".svg"}, command.input.files);
      !known)
    return report_failure(known.error());
  const auto look = look_of(command);
  if (!look) return report_failure(look.error());
  say_curves_left_out(document, common.quiet);
  const core::Progress progress = interactive_progress(common.quiet);
  std::vector<SurfaceSubject> subjects;
  json all = json::array();
  for (std::size_t i = 0; i < document.surfaces.size(); ++i) {
    const double count = static_cast<double>(document.surfaces.size());
    auto subject = valued(name_of(document, i), document.surfaces[i].surface, command,
                          core::part_of(progress, i / count, (i + 1) / count));
    if (!subject) return report_failure(subject.error(), command.input.files.front());
    subject->trims = document.surfaces[i].trims;
    all.push_back(result_of(*subject));
    subjects.push_back(std::move(*subject));
  }
  end_progress();
  if (!common.json && !common.quiet)
    for (const json& result : all) print_summary(result);
  const json shown = all.size() == 1 ? json(all[0]) : json{{"surfaces", all}};
  const operations::ReportOptions options = report_options(command, document);
  Writers writers;
  writers[".json"] = [&]() -> Result<std::string> { return shown.dump(1) + "\n"; };
  add_pictures(writers, subjects, options, *look);
  if (auto done = write_outputs(common, writers); !done) return report_failure(done.error());
  if (common.json) fmt::print("{}\n", shown.dump());
  return kDone;
}

}  // namespace keyline::app
