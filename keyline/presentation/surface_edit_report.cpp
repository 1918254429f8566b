#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/figure/plot.h"
#include "keyline/figure/ticks.h"
#include "keyline/presentation/report_parts.h"
#include "keyline/presentation/surface_pictures.h"
#include "keyline/presentation/surface_tables.h"

namespace keyline::presentation {

using core::Result;
using figure::Drawing;
using surface::FieldKind;
using surface::Surface;

namespace {

std::string number(double x) { return figure::short_number(x, 4); }

struct Pair {
  Drawing before;
  Drawing after;
};

/// Usual range of a curvature over all surfaces, so that one spike does not take all the colours.
core::Interval common_range(const Surface& given, const std::vector<Surface>& edited,
                            FieldKind field) {
  const int places = edited.size() > 9 ? 17 : 65;
  std::vector<double> all;
  const auto take = [&](const Surface& s, int count) {
    const auto found = surface::interrogate(surface::sample_grid(s, count, count), field);
    if (found) all.insert(all.end(), found->values.begin(), found->values.end());
  };
  take(given, 65);
  for (const Surface& s : edited) take(s, places);
  return usual_range(std::move(all));
}

/// The same picture of both, in the lights of the first and in the same colours.
Result<Pair> before_and_after(const Surface& given, const std::vector<Surface>& edited,
                              FieldKind field, const std::string& title, const std::string& unit) {
  SurfacePicture picture;
  picture.field = field;
  picture.unit = unit;
  picture.lighting = surface::completed({}, surface::sample_grid(given, 33, 33));
  picture.stripe_count = stripes_for({given});
  picture.range = common_range(given, edited, field);
  picture.title = title + ", before";
  auto before = surface_picture({given}, picture);
  if (!before) return std::unexpected(before.error());
  picture.title = title + ", after";
  auto after = surface_picture(edited, picture);
  if (!after) return std::unexpected(after.error());
  return Pair{std::move(*before), std::move(*after)};
}

/// Zebra and mean curvature, before on the left and after on the right.
Result<Drawing> shots_before_and_after(const Surface& given, const std::vector<Surface>& edited,
                                       const std::string& unit) {
  std::vector<Drawing> cells;
  for (const auto& [field, title] :
       {std::pair{FieldKind::zebra, "Zebra"}, {FieldKind::mean, "Mean curvature"}}) {
    auto pair = before_and_after(given, edited, field, title, unit);
    if (!pair) return std::unexpected(pair.error());
    cells.push_back(std::move(pair->before));
    cells.push_back(std::move(pair->after));
  }
  return figure::tile(cells, 2);
}

}  // namespace

Result<Drawing> surface_edit_page(const surface::BezierSurface& given,
                                  const surface::EditResult& edited, const ReportOptions& options) {
  auto shots = shots_before_and_after(given, {edited.surface}, options.unit);
  if (!shots) return shots;
  return figure::stack({std::move(*shots),
                        network_profiles(given, "Network curves, before", options.unit),
                        network_profiles(edited.surface, "Network curves, after", options.unit)});
}

namespace {

/// Targets by departure; values below a thousandth stand at the foot.
Drawing tradeoff_chart(const surface::EditResult& edited, const std::string& unit) {
  figure::Plot plot;
  plot.title = "What lower values cost";
  plot.x.title = unit.empty() ? "largest departure" : "largest departure [" + unit + "]";
  plot.x.low = 0;
  plot.y = {"SAV", figure::Scale::log10, 1e-3, 1000};
  figure::Series targets{.name = "targets", .kind = figure::SeriesKind::points, .size = 7};
  for (const surface::TradeOff& t : edited.tradeoff)
    targets.points.push_back({t.departure, std::max(t.sav, 1.3e-3)});
  figure::Series taken{.name = "taken",
                       .points = {{edited.departure, std::max(edited.after.sav, 1.3e-3)}},
                       .kind = figure::SeriesKind::points,
                       .color = figure::palette(1),
                       .marker = figure::Marker::circle,
                       .size = 12};
  plot.series = {std::move(targets), std::move(taken)};
  return figure::draw(plot);
}

report::ReportTable tradeoff_table(const surface::EditResult& edited) {
  report::ReportTable table{"What lower values cost: targets by departure",
                            {{"Target", report::Alignment::text}, {"Departure"}, {"SAV"}},
                            {}};
  for (const surface::TradeOff& t : edited.tradeoff)
    table.rows.push_back({t.name, number(t.departure), number(t.sav)});
  return table;
}

/// Verdict, numbers and notes of the report.
void tell_edit(const surface::EditResult& edited, const std::string& unit, report::Report& report) {
  report.verdict = edited.after.sav <= 1 ? report::Verdict::good : report::Verdict::caution;
  report.verdict_line =
      fmt::format("SAV from {} to {}, {} from the given surface.", number(edited.before.sav),
                  number(edited.after.sav), number(edited.departure));
  report.numbers = {
      {"SAV before", number(edited.before.sav), {}},
      {"SAV after", number(edited.after.sav), {}},
      {"Largest departure", number(edited.departure) + (unit.empty() ? "" : "\u00A0" + unit), {}},
      {"Target", edited.target, fmt::format("{:.0f} %", 100 * edited.amount)}};
  for (const surface::MissedTarget& m : edited.missed)
    report.notes.push_back(
        {report::NoteKind::note,
         fmt::format("Target \"{}\" was not found. {}: {}.", m.target, m.curve, m.why)});
  for (const surface::MissedTarget& m : edited.unmet)
    report.notes.push_back(
        {report::NoteKind::note,
         fmt::format("Short of the target {} is outside its condition: {}.", m.curve, m.why)});
}

}  // namespace

Result<report::Report> surface_edit_report(const surface::BezierSurface& given,
                                           const surface::EditResult& edited,
                                           const ReportOptions& options) {
  report::Report report = detail::headed(options, "Surface edit");
  tell_edit(edited, options.unit, report);
  auto page = surface_edit_page(given, edited, options);
  if (!page) return std::unexpected(page.error());
  report.sections.push_back({"Before and after",
                             {},
                             {{std::move(*page), "Zebra, mean curvature and network curves"}},
                             {}});
  report.sections.push_back(
      {"Surface aesthetic value",
       {},
       {{tradeoff_chart(edited, options.unit), "SAV of each target against its departure"}},
       {surface_curve_table(edited.before, "Network curves before"),
        surface_curve_table(edited.after, "Network curves after"), tradeoff_table(edited)}});
  return report;
}

// ---- Several patches ----------------------------------------------------------------------

namespace {

std::vector<Surface> patches_after(const surface::SurfaceEdit& edit) {
  return {edit.edited.surfaces.begin(), edit.edited.surfaces.end()};
}

double sum_of(const std::vector<surface::PatchValue>& values) {
  double sum = 0;
  for (const surface::PatchValue& p : values) sum += p.value.sav;
  return sum;
}

report::ReportTable patch_edits_table(const surface::SurfaceEdit& edit) {
  using report::Alignment;
  report::ReportTable table{"Patches, counted along u and v",
                            {{"Patch", Alignment::text},
                             {"SAV before"},
                             {"SAV after"},
                             {"Departure"},
                             {"Target", Alignment::text}},
                            {}};
  for (std::size_t i = 0; i < edit.edited.patches.size() && i < kMostPatchRows; ++i) {
    const auto& [result, why] = edit.edited.patches[i];
    const std::string place = fmt::format("{}, {}", i / static_cast<std::size_t>(edit.grid.columns),
                                          i % static_cast<std::size_t>(edit.grid.columns));
    if (result)
      table.rows.push_back({place, number(result->before.sav), number(result->after.sav),
                            number(result->departure), result->target});
    else
      table.rows.push_back({place, "", "", "", "as given: " + why.message});
  }
  return table;
}

/// Rounding of doubles is no gap and no fold.
double told(double x) { return x < 1e-9 ? 0 : x; }

report::ReportTable joints_table(const surface::PatchesEdit& edited) {
  report::ReportTable table{"Joints between the patches",
                            {{"", report::Alignment::text},
                             {"Joints"},
                             {"G0"},
                             {"G1"},
                             {"G2"},
                             {"Largest gap"},
                             {"Largest fold"},
                             {"Zebra jumps"},
                             {"at most"},
                             {"Zebra turns"},
                             {"at most"}},
                            {}};
  const auto degrees = [](double radians) { return number(told(radians * 180 / core::kPi)) + "°"; };
  for (const auto& [name, j] :
       {std::pair{"before", &edited.before}, std::pair{"after", &edited.after}})
    table.rows.push_back({name, std::to_string(j->joints), std::to_string(j->order_at_least[0]),
                          std::to_string(j->order_at_least[1]),
                          std::to_string(j->order_at_least[2]), number(told(j->gap)),
                          degrees(j->angle), degrees(j->zebra.mean_jump), degrees(j->zebra.jump),
                          degrees(j->zebra.mean_turn), degrees(j->zebra.turn)});
  return table;
}

/// What joints lost, in words; empty where that is nothing.
std::string joint_loss(const surface::PatchesEdit& edited) {
  const auto lost = [&](std::size_t order) {
    const std::size_t was = edited.before.order_at_least[order];
    const std::size_t is = edited.after.order_at_least[order];
    return is < was ? fmt::format("{} of {} ", was - is, was) : std::string();
  };
  if (!lost(0).empty()) return "edges that met before have gaps now";
  if (!lost(1).empty()) return lost(1) + "tangent joints have a fold now";
  if (!lost(2).empty())
    return lost(2) + "joints lost their common curvature: zebra stripes turn there";
  return "";
}

}  // namespace

Result<Drawing> surface_edit_page(const Surface& given, const surface::SurfaceEdit& edit,
                                  const ReportOptions& options) {
  return shots_before_and_after(given, patches_after(edit), options.unit);
}

Result<report::Report> surface_edit_report(const Surface& given, const surface::SurfaceEdit& edit,
                                           const ReportOptions& options) {
  report::Report report = detail::headed(options, "Surface edit");
  const double before = sum_of(values_before(edit));
  const double after = sum_of(values_after(edit));
  const surface::PatchesEdit& all = edit.edited;
  const std::string loss = joint_loss(all);
  report.verdict = loss.empty() ? report::Verdict::good : report::Verdict::caution;
  report.verdict_line = fmt::format(
      "SAV of {} from {} to {}; {}.", core::counted(all.surfaces.size(), "patch", "patches"),
      number(before), number(after), loss.empty() ? "their joints are as good as before" : loss);
  report.numbers = {{"SAV before", number(before), "sum of all patches"},
                    {"SAV after", number(after), {}},
                    {"Largest departure",
                     number(all.departure) + (options.unit.empty() ? "" : "\u00A0" + options.unit),
                     {}}};
  auto page = surface_edit_page(given, edit, options);
  if (!page) return std::unexpected(page.error());
  report.sections.push_back(
      {"Before and after", {}, {{std::move(*page), "Zebra and mean curvature"}}, {}});
  report.sections.push_back(
      {"Patch by patch", {}, {}, {joints_table(all), patch_edits_table(edit)}});
  return report;
}

}  // namespace keyline::presentation
