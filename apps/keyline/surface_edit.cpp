#include "keyline/operations/surface_edit.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/angle.h"
#include "keyline/exchange/json_surface.h"
#include "keyline/operations/fair_report.h"
#include "keyline/operations/surface_pictures.h"
#include "keyline/report/html_report.h"

#include "output.h"
#include "surface_commands.h"
#include "terminal.h"
#include "typed.h"

namespace keyline::app {
namespace {

using core::Result;
using nlohmann::json;

struct Edited {
  std::string name;
  surface::Surface given;
  surface::SurfaceEdit result;

  /// Where the surface is one patch.
  const surface::EditResult* one() const {
    const auto& patches = result.edited.patches;
    return patches.size() == 1 && patches.front().result ? &*patches.front().result : nullptr;
  }
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
    all.push_back(text);
  }
  return all;
}

Result<json> request_of(const EditCommand& command) {
  json request{{"amount", command.amount}};
  if (!command.keep.empty()) request["keep"] = command.keep;
  auto conditions = conditions_of(command);
  if (!conditions) return conditions;
  request["conditions"] = std::move(*conditions);
  if (command.limit) request["limit"] = *command.limit;
  if (command.alpha_max) request["alpha_max"] = *command.alpha_max;
  if (command.end_tolerance) request["end_tolerance"] = *command.end_tolerance;
  return request;
}

void print_one(const surface::EditResult& r) {
  fmt::print("SAV {:.5g} to {:.5g}  departure {:.4g}  target {} ({:.3g} %)\n", r.before.sav,
             r.after.sav, r.departure, r.target, 100 * r.amount);
  fmt::print("{:>31} {:>11} {:>11}\n", "target", "departure", "SAV");
  for (const surface::TradeOff& t : r.tradeoff)
    fmt::print("{:>31} {:>11.5g} {:>11.5g}\n", t.name, t.departure, t.sav);
  for (const surface::MissedTarget& m : r.missed)
    fmt::print("{:>31} not found: {}, {}\n", m.target, m.curve, m.why);
  for (const surface::MissedTarget& m : r.unmet)
    fmt::print("short of the target {} is outside its condition: {}\n", m.curve, m.why);
}

void print_patches(const surface::SurfaceEdit& edit) {
  double before = 0;
  double after = 0;
  for (const auto& p : values_before(edit)) before += p.value.sav;
  for (const auto& p : values_after(edit)) after += p.value.sav;
  fmt::print("{} patches  SAV {:.5g} to {:.5g}  largest departure {:.4g}\n",
             edit.edited.patches.size(), before, after, edit.edited.departure);
  if (edit.edited.lost > 0)
    fmt::print("{} of {} joints lost their order\n", edit.edited.lost, edit.edited.joints.size());
  if (edit.edited.sav_apart < after)
    fmt::print("joints are held; each patch for itself would come to SAV {:.5g}\n",
               edit.edited.sav_apart);
  fmt::print("{:>8} {:>11} {:>11} {:>11}  {}\n", "patch", "SAV", "after", "departure", "target");
  for (std::size_t i = 0; i < edit.edited.patches.size(); ++i) {
    const auto& [result, why] = edit.edited.patches[i];
    const auto columns = static_cast<std::size_t>(edit.grid.columns);
    const std::string place = fmt::format("{},{}", i / columns, i % columns);
    if (result)
      fmt::print("{:>8} {:>11.5g} {:>11.5g} {:>11.4g}  {}\n", place, result->before.sav,
                 result->after.sav, result->departure, result->target);
    else
      fmt::print("{:>8} as given: {}\n", place, why.message);
  }
}

void print_summary(const Edited& e) {
  if (!e.name.empty()) fmt::print("{}\n", e.name);
  if (const auto* one = e.one())
    print_one(*one);
  else
    print_patches(e.result);
}

/// Joints between all patches of the file, also of different surfaces.
struct Joints {
  surface::JointSummary before;
  surface::JointSummary after;
};

Joints joints_between(const std::vector<Edited>& all) {
  std::vector<surface::BezierSurface> given;
  std::vector<surface::BezierSurface> edited;
  for (const Edited& e : all) {
    const auto& patches = e.result.grid.patches;
    given.insert(given.end(), patches.begin(), patches.end());
    edited.insert(edited.end(), e.result.edited.surfaces.begin(), e.result.edited.surfaces.end());
  }
  const auto joints = surface::joints_of(given, 10 * surface::EdgeTolerance{}.gap);
  return {measure_joints(joints, given), measure_joints(joints, edited)};
}

void print_joints(const Joints& j) {
  if (j.before.joints == 0) return;
  const auto told = [](double x) { return x < 1e-9 ? 0 : x; };  // rounding is no gap
  fmt::print(
      "joints {}  largest gap {:.3g} to {:.3g}  largest fold {:.3g} to {:.3g} degrees  "
      "G0 {} to {}  G1 {} to {}  G2 {} to {}\n",
      j.before.joints, told(j.before.gap), told(j.after.gap),
      told(j.before.angle * 180 / core::kPi), told(j.after.angle * 180 / core::kPi),
      j.before.order_at_least[0], j.after.order_at_least[0], j.before.order_at_least[1],
      j.after.order_at_least[1], j.before.order_at_least[2], j.after.order_at_least[2]);
  if (j.after.order_at_least[1] < j.before.order_at_least[1])
    fmt::print("warning: {} of {} tangent joints are lost\n",
               j.before.order_at_least[1] - j.after.order_at_least[1], j.before.order_at_least[1]);
}

operations::ReportOptions report_options(const EditCommand& command, const std::string& unit,
                                         const std::string& name) {
  operations::ReportOptions options;
  options.title = name.empty() ? "Edited surface" : "Edited surface: " + name;
  options.subtitle = command.input.files.front();
  options.unit = unit.empty() ? command.input.unit : unit;
  options.command = command.common.command_line;
  options.generator = "Keyline " KEYLINE_VERSION;
  options.options = {{"amount", fmt::format("{:g}", command.amount)}};
  if (!command.keep.empty()) options.options.push_back({"keep", command.keep});
  for (const std::string& c : command.conditions) options.options.push_back({"condition", c});
  return options;
}

Result<figure::Drawing> page_of(const EditCommand& command, const std::vector<Edited>& all,
                                const std::string& unit) {
  std::vector<figure::Drawing> pages;
  for (const Edited& e : all) {
    const auto options = report_options(command, unit, e.name);
    auto page =
        e.one() ? operations::surface_edit_page(e.result.grid.patches.front(), *e.one(), options)
                : operations::surface_edit_page(e.given, e.result, options);
    if (!page) return page;
    pages.push_back(std::move(*page));
  }
  return figure::stack(pages);
}

Result<report::Report> report_of(const Edited& e, const operations::ReportOptions& options) {
  if (e.one())
    return operations::surface_edit_report(e.result.grid.patches.front(), *e.one(), options);
  return operations::surface_edit_report(e.given, e.result, options);
}

void add_pictures(Writers& writers, const EditCommand& command, const std::vector<Edited>& all,
                  const std::string& unit) {
  writers[".html"] = [&, unit]() -> Result<std::string> {
    std::vector<report::Report> reports;
    for (const Edited& e : all) {
      auto made = report_of(e, report_options(command, unit, e.name));
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

/// The surface as edited, in the kind it was, or as its patches where they no longer meet.
void add_edited(const document::NamedSurface& named, const surface::SurfaceEdit& edit,
                document::Document& written) {
  if (edit.whole) {
    written.surfaces.push_back({named.label, *edit.whole, 0});
    return;
  }
  const auto columns = static_cast<std::size_t>(edit.grid.columns);
  for (std::size_t i = 0; i < edit.edited.surfaces.size(); ++i) {
    document::Label label = named.label;
    label.name = fmt::format("{}/patch-{}-{}", label.name.empty() ? "surface" : label.name,
                             i / columns, i % columns);
    written.surfaces.push_back({std::move(label), edit.edited.surfaces[i], 0});
  }
}

/// What was edited and how it is written and shown.
struct Session {
  std::vector<Edited> all;
  document::Document written;
  json shown = json::array();
};

/// All surfaces of a file as one problem, so that joints between them hold too; nothing where that
/// has no answer or there is one surface alone.
std::optional<std::vector<surface::SurfaceEdit>> edited_together(
    const document::Document& document, const surface::EditOptions& options, int threads) {
  if (document.surfaces.size() < 2) return {};
  std::vector<surface::Surface> all;
  for (const document::NamedSurface& named : document.surfaces) all.push_back(named.surface);
  auto edits = surface::edit_surfaces(all, options, threads);
  if (!edits) return {};
  return std::move(*edits);
}

/// One of them; or why none of its patches could be edited.
Result<surface::SurfaceEdit> taken(surface::SurfaceEdit& edit) {
  for (const surface::PatchEdit& p : edit.edited.patches)
    if (p.result) return std::move(edit);
  return std::unexpected(edit.edited.patches.front().why);
}

/// Edits every surface; one of several that cannot be stays as given, and that is said.
Result<Session> edit_all(const EditCommand& command, const document::Document& document,
                         const json& request, const core::Progress& progress) {
  Session session;
  session.written.unit = document.unit;
  std::optional<core::Failure> failure;
  std::optional<std::vector<surface::SurfaceEdit>> together;
  for (std::size_t i = 0; i < document.surfaces.size(); ++i) {
    const document::NamedSurface& named = document.surfaces[i];
    const bool several =
        document.surfaces.size() > 1 || surface::patches_of(named.surface).patches.size() > 1;
    json whole = request;
    whole["surface"] = exchange::to_json(named.surface);
    const auto asked = from_json<operations::SurfaceEditRequest>(whole, "surface.edit");
    if (!asked) return std::unexpected(asked.error());
    surface::EditOptions options = operations::surface_edit_options(*asked, several);
    const double count = static_cast<double>(document.surfaces.size());
    options.progress = core::part_of(progress, i / count, (i + 1) / count);
    if (i == 0) together = edited_together(document, options, command.common.threads);
    auto edit = together ? taken((*together)[i])
                         : surface::edit_surface(named.surface, options, command.common.threads);
    if (!edit && edit.error().code == core::ErrorCode::cancelled)
      return std::unexpected(edit.error());
    if (!edit) {
      const std::string name = named.label.name.empty() ? "a surface" : named.label.name;
      if (document.surfaces.size() > 1)
        say(command.common.quiet, name + " left as given: " + edit.error().message);
      if (!failure) failure = edit.error();
      session.written.surfaces.push_back(named);
      continue;
    }
    add_edited(named, *edit, session.written);
    session.shown.push_back(to_json(operations::surface_edit_answer(*edit)));
    if (!named.label.name.empty()) session.shown.back()["name"] = named.label.name;
    session.all.push_back({named.label.name, named.surface, std::move(*edit)});
  }
  if (session.all.empty() && failure) return std::unexpected(*failure);
  return session;
}

}  // namespace

int edit_surfaces(const EditCommand& command, const document::Document& document) {
  const CommonOptions& common = command.common;
  const auto request = request_of(command);
  if (!request) return report_failure(request.error());
  say_curves_left_out(document, common.quiet);
  auto session = edit_all(command, document, *request, interactive_progress(common.quiet));
  end_progress();
  if (!session) return report_failure(session.error(), command.input.files.front());
  const Joints joints = joints_between(session->all);
  if (!common.json && !common.quiet) {
    for (const Edited& e : session->all) print_summary(e);
    print_joints(joints);
  }
  Writers writers = curve_writers(session->written, common.tolerance.value_or(1e-6), common);
  add_pictures(writers, command, session->all, document.unit);
  if (auto done = write_outputs(common, writers); !done) return report_failure(done.error());
  if (!common.json) return kDone;
  json shown =
      session->shown.size() == 1 ? json(session->shown[0]) : json{{"surfaces", session->shown}};
  if (session->shown.size() > 1)
    shown["joints"] = {{"before", to_json(operations::shown(joints.before))},
                       {"after", to_json(operations::shown(joints.after))}};
  fmt::print("{}\n", shown.dump());
  return kDone;
}

}  // namespace keyline::app
