#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "keyline/core/text.h"
#include "keyline/operations/curve_edit.h"
#include "keyline/operations/surface_edit.h"

#include "session.h"
#include "surface_text.h"
#include "terminal.h"

namespace keyline::app {
namespace {

using core::Result;
using nlohmann::json;
using presentation::Shown;

constexpr std::size_t kCurves = 0;  // records of the command line
constexpr std::size_t kSurfaces = 1;
constexpr std::size_t kReading = 2;

/// A curve given by its matrix is no file's.
OptionGroup curve_group() {
  OptionGroup group = group_of(*operations::find_operation("curve.edit"), "Curves");
  for (const char* other : {"alpha", "s", "degree", "tangent", "beta", "start", "matrix"})
    group.without.emplace_back(other);
  return group;
}

Session new_session() {
  return Session(
      {"edit", "FILE... ", "A curve or patch towards Class A and least energy.",
       "Example: keyline edit examples/cubic.json --end-tolerance 0.01 -o report.html\n"
       "         keyline edit examples/panel-c.json --keep corners --limit 5 -o panel.json\n"
       "Formats: svg, json (the exact Bezier), csv (samples), html (report), pdf, png, dxf and "
       "what "
       "convert writes.",
       operations::further_options(*operations::find_operation("curve.edit"))},
      {curve_group(), group_of(*operations::find_operation("surface.edit_together"), "Surfaces"),
       reading_group(), door_group()});
}

std::string number_text(const json& number, int digits) {
  return number.is_number() ? core::number_text(number.get<double>(), digits) : "-";
}

std::string text_of(const std::string& name, const json& result) {
  std::string text = name.empty() ? "" : name + "\n";
  const json& before = result["before"];
  if (before.contains("approximation"))
    text += fmt::format("approximated by degree {} within {:.4g}\n",
                        before["approximation"]["degree"].get<int>(),
                        before["approximation"]["deviation"].get<double>());
  text += fmt::format("{:>8} {:>5} {:>11} {:>21} {:>11} {:>10}\n", "", "type", "CAV", "alpha, s",
                      "energy", "monotone");
  for (const char* word : {"before", "after"}) {
    const json& v = result[word];
    const std::string place =
        v["alpha"].is_number() ? number_text(v["alpha"], 6) + " " + number_text(v["s"], 6) : "-";
    text += fmt::format("{:>8} {:>5} {:>11} {:>21} {:>11} {:>10}\n", word, v["type"].get<int>(),
                        number_text(v["cav"], 6), place, number_text(v["energy"], 6),
                        v["monotone"].get<std::string>());
  }
  text += fmt::format("departure {:.4g} at most\n", result["departure"].get<double>());
  if (const auto moved = result["end_moved"].get<double>(); moved > 0)
    text += fmt::format("the end that is let go moves by {:.4g}\n", moved);
  return text;
}

std::string pieces_text(const std::string& name, const json& result) {
  const json& pieces = result["pieces"];
  std::string text = name.empty() ? "" : name + "\n";
  text += fmt::format("{}, {} to Class A  CAV {:.5g} to {:.5g}  largest departure {:.4g}\n",
                      core::counted(pieces.size(), "piece"), result["edited"].get<int>(),
                      result["cav_before"].get<double>(), result["cav_after"].get<double>(),
                      result["departure"].get<double>());
  if (const auto off = result["approximated"].get<double>(); off > 0)
    text += fmt::format("made of Beziers within {:.4g} of the given curve\n", off);
  const json& before = result["joints_before"];
  const json& after = result["joints_after"];
  if (before["g0"] != 0)
    text += fmt::format("joints {}  G1 {} to {}  G2 {} to {}\n", before["g0"].get<int>(),
                        before["g1"].get<int>(), after["g1"].get<int>(), before["g2"].get<int>(),
                        after["g2"].get<int>());
  const auto one_way = [&](const char* when) {
    return std::ranges::count_if(
        pieces, [&](const json& piece) { return piece[when].value("monotone", json()) == "yes"; });
  };
  if (std::ranges::any_of(pieces, [](const json& p) { return p["before"].contains("monotone"); }))
    text += fmt::format("curvature runs one way in {} to {} of them\n", one_way("before"),
                        one_way("after"));
  std::map<std::string, int> kept;
  for (const json& piece : pieces)
    if (piece.contains("why")) ++kept[piece["why"].get<std::string>()];
  for (const auto& [why, count] : kept) text += fmt::format("{} kept: {}\n", count, why);
  return text;
}

/// What became of the curves of the files.
struct EditedCurves {
  std::vector<Shown> whole;  ///< of curve.edit
  std::vector<json> shown;
  json curves = json::array();
  std::string text;
  std::vector<std::string> left;  ///< as given, and why
  core::Failure first;            ///< of those
};

/// Whether pieces of the curve may do where one Bezier does not: none comes near enough and no
/// tolerance was asked for, or the curve is closed.
bool pieces_may_do(const json& request, const core::Failure& why) {
  if (request.contains("fit_tolerance") || request.contains("target")) return false;
  // A spline of several pieces in space.
  if (why.code == core::ErrorCode::unsupported) return why.path == "curve";
  return why.path == option_name("fit_tolerance") ||
         (why.path == "curve" && request["curve"]["type"] != "bezier");
}

/// As one Bezier, or piece by piece.
Result<operations::Outcome> edit_one(Session& session, const json& request) {
  auto whole = session.perform("curve.edit", request, {});
  if (whole || !pieces_may_do(request, whole.error())) return whole;
  json pieces = {{"curve", request["curve"]}};
  for (const char* field : {"amount", "alpha_max"})
    if (request.contains(field)) pieces[field] = request[field];
  return session.perform("curve.edit_pieces", pieces, {});
}

/// `heading`: what the curve is called on the terminal and in reports.
Result<void> add_curve(Session& session, const json& thing, const std::string& heading,
                       json& request, EditedCurves& all) {
  request["curve"] = curve_of(thing);
  const std::string name = thing["name"].get<std::string>();
  auto outcome = edit_one(session, request);
  if (!outcome) {
    if (all.left.empty()) all.first = outcome.error();
    all.left.push_back((heading.empty() ? "the curve" : heading) +
                       " left as given: " + outcome.error().message);
    all.curves.push_back(thing);
    return {};
  }
  auto one = shown_of(*outcome);
  if (!one) return std::unexpected(one.error());
  const bool pieces = one->contains("pieces");
  all.text += pieces ? pieces_text(heading, *one) : text_of(heading, *one);
  json written = thing;
  written["curve"] = (*one)["curve"];
  written.erase("line");
  all.curves.push_back(std::move(written));
  if (!name.empty()) (*one)["name"] = name;
  all.shown.push_back(std::move(*one));
  if (!pieces && outcome->result_as<operations::CurveEditAnswer>()->edited)
    all.whole.push_back({heading, std::move(*outcome)});
  return {};
}

int write_curves(Session& session, const ReadFiles& read, const EditedCurves& all) {
  presentation::ReportOptions options = session.report_options();
  options.unit = read.shown["unit"].get<std::string>();
  const json document{{"unit", read.shown["unit"]}, {"curves", all.curves}};
  presentation::Pages pages;
  if (all.whole.size() == all.shown.size()) {
    pages = presentation::edit_pages(all.whole, options);
  } else if (!session.door().output.empty()) {
    const auto output = presentation::output_of(document);
    if (!output) return report_failure(output.error());
    options.title = "Edited curves";
    pages = presentation::document_pages(output->document, options);
  }
  auto written = session.write(pages, document);
  if (!written) return report_failure(written.error());
  session.print(one_or_all(all.shown, "curves"), all.text);
  return kDone;
}

int edit_curves(Session& session, const ReadFiles& read) {
  json request = session.of(kCurves);
  if (session.door().tolerance && !request.contains("fit_tolerance"))
    request["fit_tolerance"] = *session.door().tolerance;
  EditedCurves all;
  const json& curves = read.shown["curves"];
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::string name = curves[i]["name"].get<std::string>();
    const std::string heading = called(name, "curve", i, curves.size());
    if (auto done = add_curve(session, curves[i], heading, request, all); !done)
      return report_failure(done.error());
  }
  if (all.shown.empty() && !all.left.empty())
    return report_failure(all.first, session.files().front());
  if (all.shown.empty())
    return report_failure({core::ErrorCode::bad_input, "there is no curve or patch to edit",
                           "give a file that holds one", ""},
                          session.files().front());
  for (const std::string& why : all.left) say(session.door().quiet, why);
  return write_curves(session, read, all);
}

/// The surface as edited, in the kind it was, or as its patches where they no longer meet.
void add_edited(const json& given, const json& edit, json& written) {
  json label = given;
  if (edit["surface"].is_object()) {
    label["surface"] = edit["surface"];
    label["trims"] = 0;
    written.push_back(std::move(label));
    return;
  }
  const std::string name = given["name"].get<std::string>();
  for (std::size_t i = 0; i < edit["surfaces"].size(); ++i) {
    const json& place = edit["patch_edits"][i]["patch"];
    label["name"] = fmt::format("{}/patch-{}-{}", name.empty() ? "surface" : name,
                                place[0].get<int>(), place[1].get<int>());
    label["surface"] = edit["surfaces"][i];
    label["trims"] = 0;
    written.push_back(label);
  }
}

/// Why surfaces that are worth something else than nothing may come back as they were, where the
/// text of one of several patches does not say so.
std::string as_given_text(const std::vector<json>& edits, const json& joints) {
  const bool said =
      std::ranges::any_of(edits, [](const json& edit) { return edit.contains("patch_edits"); });
  const bool stays = std::ranges::all_of(
      edits, [](const json& edit) { return edit["departure"].get<double>() == 0; });
  const bool wanted = std::ranges::any_of(
      edits, [](const json& edit) { return edit["before"]["sav"].get<double>() > 0; });
  return stays && wanted && !said && joints["before"]["joints"].get<int>() > 0
             ? "all as given: nothing within the limit lowers SAV and keeps of the joints what is "
               "to be kept; --limit may allow more, --joints G1 or free keeps less\n"
             : "";
}

int edit_surfaces(Session& session, const ReadFiles& read) {
  say_curves_left_out(read.shown, session.door().quiet);
  json request = session.of(kSurfaces);
  const json& given = read.shown["surfaces"];
  for (const json& one : given) request["surfaces"].push_back(one["surface"]);
  const auto outcome = session.perform("surface.edit_together", request, session.progress());
  end_progress();
  if (!outcome) return report_failure(outcome.error(), session.files().front());
  const auto result = shown_of(*outcome);
  if (!result) return report_failure(result.error());
  json written = json::array();
  std::vector<json> shown;
  std::string text;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string name = given[i]["name"].get<std::string>();
    const std::string heading = called(name, "surface", i, given.size());
    const json& one = (*result)["surfaces"][i];
    if (!one.contains("edit")) {
      say(session.door().quiet, (heading.empty() ? "the surface" : heading) +
                                    " left as given: " + one["why"].get<std::string>());
      written.push_back(given[i]);
      continue;
    }
    add_edited(given[i], one["edit"], written);
    text += surface_edit_text(heading, one["edit"]);
    shown.push_back(one["edit"]);
    if (!name.empty()) shown.back()["name"] = name;
  }
  presentation::ReportOptions options = session.report_options();
  options.unit = read.shown["unit"].get<std::string>();
  const auto pages = presentation::surface_edit_pages(read.answer().surfaces, *outcome, options);
  auto done = session.write(pages, json{{"unit", read.shown["unit"]}, {"surfaces", written}});
  if (!done) return report_failure(done.error());
  json all = one_or_all(shown, "surfaces");
  if (shown.size() > 1) all["joints"] = (*result)["joints"];
  session.print(
      all, text + joints_text((*result)["joints"]) + as_given_text(shown, (*result)["joints"]));
  return kDone;
}

/// Curves in a plane come in its coordinates; a file of others alone as it is.
Result<ReadFiles> read_to_edit(Session& session) {
  auto planar = read_files(session, session.of(kReading), true);
  if (planar || planar.error().code != core::ErrorCode::bad_input) return planar;
  auto space = read_files(session, session.of(kReading), false);
  return space && !space->answer().curves.empty() ? std::move(space) : std::move(planar);
}

}  // namespace

int run_edit(const Words& words) {
  Session session = new_session();
  if (const auto status = session.begin(words)) return *status;
  if (auto done = session.check_outputs(); !done) return report_failure(done.error());
  const auto read = read_to_edit(session);
  if (!read) return report_failure(read.error());
  const bool surfaces = !read->answer().surfaces.empty();
  if (auto sound = surfaces
                       ? check_unused(session.of(kSurfaces), session.of(kCurves), "for curves")
                       : check_unused(session.of(kCurves), session.of(kSurfaces), "for surfaces");
      !sound)
    return report_failure(sound.error());
  session.note_read(read->answer());
  return surfaces ? edit_surfaces(session, *read) : edit_curves(session, *read);
}

Manual edit_manual() { return new_session().manual(); }

}  // namespace keyline::app
