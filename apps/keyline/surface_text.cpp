#include "surface_text.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"

#include "terminal.h"

namespace keyline::app {
namespace {

using nlohmann::json;

constexpr double kSharper = 0.016 * std::numbers::pi / 180;  ///< what counts as a fold

/// Rounding is no gap and no fold.
double told(double x) { return x < 1e-9 ? 0 : x; }

double degrees_of(double radians) { return told(radians) * 180 / std::numbers::pi; }

std::string number_of(const json& number) {
  return number.is_number() ? fmt::format("{:.5g}", number.get<double>()) : "-";
}

std::string place_of(const json& patch) {
  return fmt::format("{},{}", patch[0].get<int>(), patch[1].get<int>());
}

std::string curves_text(const json& curves) {
  const bool nearest =
      std::ranges::any_of(curves, [](const json& c) { return c.contains("nearest"); });
  std::string text =
      fmt::format("{:>6} {:>5} {:>10} {:>9} {:>9} {:>9} {:>9} {:>11}{}\n", "curve", "type", "CAV",
                  "alpha", "s", "least a", "least s", "energy",
                  nearest ? fmt::format(" {:>12} {:>9}", "nearest away", "its CAV") : "");
  for (const json& c : curves) {
    const json least = c["minimum"].is_object() ? c["minimum"] : json::object();
    const std::string beside =
        c.contains("nearest") ? fmt::format(" {:>12} {:>9}", number_of(c["nearest"]["distance"]),
                                            number_of(c["nearest"]["cav"]))
                              : "";
    text += fmt::format("{:>6} {:>5} {:>10} {:>9} {:>9} {:>9} {:>9} {:>11}{}\n",
                        c["name"].get<std::string>(), c["type"].get<int>(), number_of(c["cav"]),
                        number_of(c["alpha"]), number_of(c["s"]),
                        number_of(least.value("alpha", json())),
                        number_of(least.value("s", json())), number_of(c["energy"]), beside);
  }
  return text;
}

std::string patches_text(const json& patches) {
  std::string text =
      fmt::format("{:>8} {:>10} {:>6} {:>11}\n", "patch", "SAV", "worst", "of nearest");
  for (const json& p : patches)
    text += fmt::format("{:>8} {:>10} {:>6} {:>11}\n", place_of(p["patch"]), number_of(p["sav"]),
                        p["worst"].get<std::string>(), number_of(p.value("nearest_sav", json())));
  return text;
}

std::string tradeoff_text(const json& found) {
  const bool joined =
      std::ranges::any_of(found, [](const json& t) { return t.contains("stripe_turn"); });
  std::string text = fmt::format("{:>31} {:>11} {:>11}{}\n", "target", "departure", "SAV",
                                 joined ? "  zebra turns" : "");
  for (const json& t : found)
    text += fmt::format(
        "{:>31} {:>11.5g} {:>11.5g}{}\n", t["target"].get<std::string>(),
        t["departure"].get<double>(), t["sav"].get<double>(),
        joined ? fmt::format(" {:>8.3g} deg", degrees_of(t["stripe_turn"].get<double>())) : "");
  return text;
}

std::string limit_text(const json& r) {
  if (!r["limit"].is_number()) return "";
  const char* usual = "of several patches a hundredth of the size, unless --limit says otherwise";
  return fmt::format("limit {:.4g} ({})\n", r["limit"].get<double>(), usual);
}

std::string one_patch_text(const json& r) {
  std::string text = fmt::format("SAV {:.5g} to {:.5g}  departure {:.4g}  target {} ({:.3g} %)\n",
                                 r["before"]["sav"].get<double>(), r["after"]["sav"].get<double>(),
                                 r["departure"].get<double>(), r["target"].get<std::string>(),
                                 100 * r["amount"].get<double>());
  text += limit_text(r);
  text += tradeoff_text(r["tradeoff"]);
  for (const json& m : r["missed"])
    text += fmt::format("{:>31} not found: {}, {}\n", m["target"].get<std::string>(),
                        m["curve"].get<std::string>(), m["why"].get<std::string>());
  for (const json& m : r.value("unmet", json::array()))
    text += fmt::format("short of the target {} is outside its condition: {}\n",
                        m["curve"].get<std::string>(), m["why"].get<std::string>());
  return text;
}

std::string many_patches_text(const json& r) {
  const json& patches = r["patch_edits"];
  std::string text = fmt::format("{}  SAV {:.5g} to {:.5g}  largest departure {:.4g}\n",
                                 core::counted(patches.size(), "patch", "patches"),
                                 r["before"]["sav"].get<double>(), r["after"]["sav"].get<double>(),
                                 r["departure"].get<double>());
  text += limit_text(r);
  if (const int lost = r["joints"]["lost"].get<int>(); lost > 0)
    text += fmt::format("{} of {} joints lost their order\n", lost,
                        r["joints"]["before"]["joints"].get<int>());
  if (r.contains("sav_apart"))
    text += fmt::format("joints are held; each patch for itself would come to SAV {:.5g}\n",
                        r["sav_apart"].get<double>());
  if (r["departure"].get<double>() == 0)
    text +=
        "as given: nothing of less SAV was found within the limit; --limit may allow more, "
        "--joints G1 or free holds less of the joints\n";
  if (r.contains("tradeoff")) text += tradeoff_text(r["tradeoff"]);
  text += fmt::format("{:>8} {:>11} {:>11} {:>11}  {}\n", "patch", "SAV", "after", "departure",
                      "target");
  for (const json& p : patches) {
    if (p.contains("why"))
      text +=
          fmt::format("{:>8} as given: {}\n", place_of(p["patch"]), p["why"].get<std::string>());
    else
      text += fmt::format("{:>8} {:>11.5g} {:>11.5g} {:>11.4g}  {}\n", place_of(p["patch"]),
                          p["sav"][0].get<double>(), p["sav"][1].get<double>(),
                          p["departure"].get<double>(), p["target"].get<std::string>());
  }
  return text;
}

}  // namespace

std::string surface_text(const json& result) {
  const json& k = result["curvature"];
  std::string text = result["name"].get<std::string>() + "\n";
  if (result.contains("trims"))
    text +=
        fmt::format("whole surface; {} a face out of it in the file\n",
                    core::counted(result["trims"].get<std::size_t>(), "edge cuts", "edges cut"));
  text += fmt::format("Gaussian curvature {} to {}  mean curvature {} to {}\n",
                      number_of(k["gaussian"]["min"]), number_of(k["gaussian"]["max"]),
                      number_of(k["mean"]["min"]), number_of(k["mean"]["max"]));
  if (!result["sav"].is_number())
    return text + fmt::format("no SAV: {}\n", result["no_value"].get<std::string>());
  text += fmt::format(
      "SAV {}{}  worst curve {}{}\n", number_of(result["sav"]),
      result.contains("nearest_sav") ? "  of the nearest curves " + number_of(result["nearest_sav"])
                                     : "",
      result["worst"].get<std::string>(),
      result.contains("worst_patch") ? " of patch " + place_of(result["worst_patch"]) : "");
  return text + (result.contains("patches") ? patches_text(result["patches"])
                                            : curves_text(result["curves"]));
}

std::string surface_edit_text(const std::string& name, const json& edit) {
  return (name.empty() ? "" : name + "\n") +
         (edit.contains("patch_edits") ? many_patches_text(edit) : one_patch_text(edit));
}

namespace {

int count(const json& joints, const char* order) { return joints[order].get<int>(); }

/// A warning for everything joints had before and have no more.
std::string lost_joints_text(const json& joints) {
  const json& before = joints["before"];
  const json& after = joints["after"];
  std::string text;
  if (count(after, "G0") < count(before, "G0"))
    text +=
        fmt::format("warning: {} of {} joints are open now; --joints zebra, G1 or G2 keeps them\n",
                    count(before, "G0") - count(after, "G0"), count(before, "G0"));
  const int torn = count(before, "G1") - count(after, "G1");
  if (torn > 0)
    text += fmt::format("warning: {} of {} tangent joints are lost, so that stripes jump there\n",
                        torn, count(before, "G1"));
  const int bent = count(before, "G2") - count(after, "G2");
  if (bent > 0)
    text += fmt::format(
        "warning: {} of {} joints lose their common curvature{}; --joints zebra holds it\n", bent,
        count(before, "G2"), bent > torn ? ", so that stripes turn there" : "");
  if (const int turned = joints["turned"].get<int>(); turned > std::max(bent, 0))
    text += fmt::format(
        "warning: stripes turn farther than before at {} of {} tangent joints; --joints zebra does "
        "not let them\n",
        turned, count(before, "G1"));
  if (const int folded = joints["folded"].get<int>(); folded > 0)
    text +=
        fmt::format("warning: {} over, so that it folds over itself; {}\n",
                    core::counted(static_cast<std::size_t>(folded), "patch turns", "patches turn"),
                    "--joints zebra, G1 or G2 lets none");
  if (const auto growth = joints["fold_growth"].get<double>(); growth > kSharper)
    text += fmt::format("warning: a fold grows by {:.3g} degrees\n", degrees_of(growth));
  return text;
}

}  // namespace

std::string joints_text(const json& joints) {
  const json& before = joints["before"];
  const json& after = joints["after"];
  if (before["joints"] == 0) return "";
  std::string text = fmt::format(
      "joints {}  largest gap {:.3g} to {:.3g}  largest fold {:.3g} to {:.3g} degrees  "
      "G0 {} to {}  G1 {} to {}  G2 {} to {}\n",
      before["joints"].get<int>(), told(before["gap"].get<double>()),
      told(after["gap"].get<double>()), degrees_of(before["angle"].get<double>()),
      degrees_of(after["angle"].get<double>()), count(before, "G0"), count(after, "G0"),
      count(before, "G1"), count(after, "G1"), count(before, "G2"), count(after, "G2"));
  const auto change = [&](const char* what) {
    return fmt::format("{:.3g} to {:.3g}", degrees_of(before["zebra"][what].get<double>()),
                       degrees_of(after["zebra"][what].get<double>()));
  };
  const bool meet = count(after, "G1") > 0 || count(before, "G1") == 0;
  text += fmt::format("zebra at joints, in degrees: jumps {} (at most {})  turns {}\n",
                      change("mean_jump"), change("jump"),
                      meet ? fmt::format("{} (at most {})", change("mean_turn"), change("turn"))
                           : "nowhere: stripes meet at no joint now");
  return text + lost_joints_text(joints);
}

std::string made_joints_text(const json& joints) {
  if (joints["joints"] == 0) return "";
  const json& zebra = joints["zebra"];
  const auto angle = [&](const char* what) { return degrees_of(zebra[what].get<double>()); };
  return fmt::format(
      "joints {}  largest gap {:.3g}  largest fold {:.3g} degrees  G0 {}  G1 {}  G2 {}\n"
      "zebra at joints, in degrees: jumps {:.3g} (at most {:.3g})  turns {:.3g} (at most {:.3g})\n",
      joints["joints"].get<int>(), told(joints["gap"].get<double>()),
      degrees_of(joints["angle"].get<double>()), count(joints, "G0"), count(joints, "G1"),
      count(joints, "G2"), angle("mean_jump"), angle("jump"), angle("mean_turn"), angle("turn"));
}

void say_curves_left_out(const json& read, bool quiet) {
  const std::size_t curves = read["curves"].size();
  if (curves == 0) return;
  say(quiet, fmt::format("{} of the file left out beside its surfaces; --select takes one",
                         core::counted(curves, "curve")));
}

}  // namespace keyline::app
