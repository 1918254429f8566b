#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "keyline/core/text.h"
#include "keyline/operations/surface_value.h"

#include "session.h"
#include "surface_text.h"
#include "terminal.h"
#include "words.h"

namespace keyline::app {
namespace {

using core::Result;
using nlohmann::json;
using presentation::ShownAnalysis;
using presentation::ShownSurface;

constexpr std::size_t kCurves = 0;  // records of the command line
constexpr std::size_t kReading = 1;
constexpr std::size_t kView = 2;

Session new_session() {
  return Session({"analyze", "FILE... ",
                  "Curvature and rhythm of curves, SAV, curvature and zebra of surfaces.",
                  "Example: keyline analyze examples/clothoid.csv -o report.html\n"
                  "         keyline analyze examples/panel-c.json -o panel.html"},
                 {group_of(*operations::find_operation("curve.analyze"), "Curves"),
                  reading_group(),
                  {"Surfaces", &core::type_of<presentation::SurfaceView>()},
                  door_group()});
}

/// The value of a curve that one Bezier curve stands for; "class_a" of the result, or why not.
json class_a_of(Session& session, const json& curve, const core::Progress& progress,
                ShownAnalysis& shown) {
  json request{{"curve", curve}};
  if (session.door().tolerance) request["fit_tolerance"] = *session.door().tolerance;
  auto value = session.perform("curve.cav", request, progress);
  if (!value) return {{"reason", value.error().message}};
  auto text = shown_of(*value);
  if (!text) return {{"reason", text.error().message}};
  shown.class_a = std::move(*value);
  return *text;
}

/// A figure of a comb, infinite where it has no bound, as at a cusp.
double figure_of(const json& value) { return value.is_number() ? value.get<double>() : HUGE_VAL; }

std::string class_a_text(const json& value) {
  if (value.contains("reason"))
    return fmt::format("class A: none; {}\n", value["reason"].get<std::string>());
  std::string line =
      fmt::format("class A: {}  CAV {:.6g}", presentation::type_in_words(value["type"].get<int>()),
                  value["cav"].get<double>());
  if (value.contains("approximation"))
    line += fmt::format("  (degree {} within {:.3g})", value["degree"].get<int>(),
                        value["approximation"]["deviation"].get<double>());
  if (value.contains("nearest") && value["nearest"].is_object()) {
    line += fmt::format("  nearest {:.3g} away", value["nearest"]["distance"].get<double>());
    if (value["nearest"]["cav"].is_number())
      line += fmt::format(", CAV {:.4g}", value["nearest"]["cav"].get<double>());
  }
  return line + "\n";
}

std::string text_of(const std::string& name, const json& result) {
  std::string text = name.empty() ? "" : name + "\n";
  const auto bound = [&result](const char* which, const char* none) {
    const json& value = result["curvature"][which];
    return value.is_number() ? core::number_text(value.get<double>(), 6) : none;
  };
  text +=
      fmt::format("length {:.8g}  curvature {} to {}  inflections {}  extrema {}  monotone {}\n",
                  result["length"].get<double>(), bound("min", "-infinity"),
                  bound("max", "infinity"), result["inflections"].size(), result["extrema"].size(),
                  result["monotone"].get<std::string>());
  text += fmt::format("comb: {}, variation {:.3g}, jolt {:.2g}\n",
                      core::counted(result["comb"]["waves"].get<std::size_t>(), "wave"),
                      figure_of(result["comb"]["energy"]), figure_of(result["comb"]["jolt"]));
  text += fmt::format("{:>5} {:>11} {:>11} {:>14} {:>11} {:>11}  {}\n", "piece", "from", "length",
                      "rhythm", "slope", "volume", "impression");
  int index = 0;
  for (const json& piece : result["pieces"]) {
    std::string slopes;
    for (const json& slope : piece["slopes"])
      slopes += fmt::format("{}{:.3g}", slopes.empty() ? "" : " ", slope.get<double>());
    text += fmt::format("{:>5} {:>11.5g} {:>11.5g} {:>14} {:>11} {:>11.4g}  {}\n", index++,
                        piece["arc_length"][0].get<double>(), piece["length"].get<double>(),
                        piece["rhythm"].get<std::string>(), slopes, piece["volume"].get<double>(),
                        piece["impression"].get<std::string>());
  }
  return text + class_a_text(result["class_a"]);
}

/// What was analysed, shown and written.
struct Analysed {
  std::vector<ShownAnalysis> pages;
  std::vector<json> shown;
  json curves = json::array();
  std::string text;
};

/// One line for each of several curves, the least calm first.
std::string overview_of(const Analysed& all) {
  if (all.shown.size() < 2) return {};
  std::vector<std::size_t> order(all.shown.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) {
    return figure_of(all.shown[i]["comb"]["energy"]);
  });
  std::string text = fmt::format(
      "all {} curves, the least calm first\n{:>10} {:>6} {:>8} {:>8} {:>11} {:>9} {:>8}  {}\n",
      order.size(), "variation", "waves", "jolt", "extrema", "inflections", "monotone", "CAV",
      "curve");
  for (const std::size_t i : order) {
    const json& one = all.shown[i];
    const json& value = one["class_a"];
    text += fmt::format(
        "{:>10.3g} {:>6} {:>8.2g} {:>8} {:>11} {:>9} {:>8}  {}\n", figure_of(one["comb"]["energy"]),
        one["comb"]["waves"].get<int>(), figure_of(one["comb"]["jolt"]), one["extrema"].size(),
        one["inflections"].size(), one["monotone"].get<std::string>(),
        value.contains("cav") ? fmt::format("{:.3g}", value["cav"].get<double>()) : "-",
        all.pages[i].analysis.name);
  }
  return text;
}

Result<void> analyze_one(Session& session, const json& thing, const core::Progress& progress,
                         std::size_t count, Analysed& all) {
  json request = session.of(kCurves);
  request.update(subject_of(thing));
  const std::string name = thing["name"].get<std::string>();
  auto outcome = session.perform("curve.analyze", request, progress);
  if (!outcome) return std::unexpected(outcome.error());
  auto shown = shown_of(*outcome);
  if (!shown) return std::unexpected(shown.error());
  const json curve = shown->contains("spline") ? (*shown)["spline"] : thing["curve"];
  const std::string heading = called(name, "curve", all.shown.size(), count);
  ShownAnalysis page{{heading, std::move(*outcome)}, {}};
  (*shown)["class_a"] = class_a_of(session, curve, progress, page);
  all.text += text_of(heading, *shown);
  if (!name.empty()) (*shown)["name"] = name;
  all.curves.push_back({{"name", name}, {"curve", curve}});
  all.shown.push_back(std::move(*shown));
  all.pages.push_back(std::move(page));
  return {};
}

/// The result in .json; pictures and drawings in the other formats.
void add_json(presentation::Pages& pages, const json& shown) {
  pages[".json"] = [text = shown.dump(1, ' ', false, json::error_handler_t::replace) +
                           "\n"]() -> Result<std::string> { return text; };
}

int analyze_curves(Session& session, const ReadFiles& read) {
  Analysed all;
  const core::Progress progress = session.progress();
  const auto things = planar_things(session, read);
  if (!things) return report_failure(things.error(), session.files().front());
  for (const json& thing : *things) {
    const std::size_t at = all.shown.size();
    if (auto done = analyze_one(session, thing, one_of_many(progress, at, things->size()),
                                things->size(), all);
        !done)
      return report_failure(told_how_far(done.error(), at, things->size()),
                            session.files().front());
  }
  end_progress();
  const json shown = one_or_all(all.shown, "curves");
  presentation::ReportOptions options = session.report_options();
  options.unit = read.shown["unit"].get<std::string>();
  presentation::Pages pages = presentation::analysis_pages(all.pages, options);
  add_json(pages, shown);
  auto written = session.write(pages, json{{"unit", read.shown["unit"]}, {"curves", all.curves}});
  if (!written) return report_failure(written.error());
  session.print(shown, all.text + overview_of(all));
  return kDone;
}

/// SAV, or why there is none, and the ranges of curvature.
Result<json> value_of(Session& session, const json& surface, const core::Progress& progress,
                      ShownSurface& shown) {
  auto value = session.perform("surface.sav", {{"surface", surface}}, progress);
  if (!value && value.error().code == core::ErrorCode::cancelled)
    return std::unexpected(value.error());
  json result{{"sav", nullptr}};
  if (value) {
    auto text = shown_of(*value);
    if (!text) return text;
    result = std::move(*text);
    shown.value = std::move(*value);
  } else {
    shown.no_value = value.error().message;
    result["no_value"] = shown.no_value;
  }
  for (const char* kind : {"gaussian", "mean"}) {
    const auto field =
        session.perform("surface.interrogate", {{"surface", surface}, {"kind", kind}}, {});
    if (!field) return std::unexpected(field.error());
    const auto text = shown_of(*field);
    if (!text) return text;
    result["curvature"][kind] = {{"min", (*text)["range"][0]}, {"max", (*text)["range"][1]}};
  }
  return result;
}

int analyze_surfaces(Session& session, const ReadFiles& read) {
  if (auto done = session.check_outputs({".json", ".html", ".png", ".pdf", ".svg"}); !done)
    return report_failure(done.error());
  const auto view = session.record<presentation::SurfaceView>(kView);
  if (!view) return report_failure(view.error());
  say_curves_left_out(read.shown, session.door().quiet);
  const core::Progress progress = session.progress();
  std::vector<ShownSurface> pages;
  std::vector<json> shown;
  std::string text;
  const auto& surfaces = read.answer().surfaces;
  const auto count = static_cast<double>(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const auto at = static_cast<double>(i);
    ShownSurface page{
        surfaces[i].name.empty() ? fmt::format("surface {}", i + 1) : surfaces[i].name,
        surfaces[i],
        {},
        {}};
    auto result = value_of(session, read.shown["surfaces"][i]["surface"],
                           core::part_of(progress, at / count, (at + 1) / count), page);
    if (!result) return report_failure(result.error(), session.files().front());
    (*result)["name"] = page.name;
    if (surfaces[i].trims > 0) (*result)["trims"] = surfaces[i].trims;
    text += surface_text(*result);
    shown.push_back(std::move(*result));
    pages.push_back(std::move(page));
  }
  end_progress();
  const json all = one_or_all(shown, "surfaces");
  presentation::ReportOptions options = session.report_options();
  options.unit = read.shown["unit"].get<std::string>();
  presentation::Pages files = presentation::surface_pages(pages, *view, options);
  add_json(files, all);
  if (auto written = session.write(files, json::object()); !written)
    return report_failure(written.error());
  session.print(all, text);
  return kDone;
}

}  // namespace

int run_analyze(const Words& words) {
  Session session = new_session();
  if (const auto status = session.begin(words)) return *status;
  if (auto done = session.check_outputs(); !done) return report_failure(done.error());
  const auto read = read_files(session, session.of(kReading), true);
  if (!read) return report_failure(read.error());
  const bool surfaces = !read->answer().surfaces.empty();
  if (auto sound = surfaces ? check_unused(session.of(kReading), session.of(kCurves), "for curves")
                            : check_unused({}, session.of(kView), "for surfaces");
      !sound)
    return report_failure(sound.error());
  session.note_read(read->answer());
  return surfaces ? analyze_surfaces(session, *read) : analyze_curves(session, *read);
}

Manual analyze_manual() { return new_session().manual(); }

}  // namespace keyline::app
