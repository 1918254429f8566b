#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "keyline/figure/plot.h"
#include "keyline/figure/ticks.h"
#include "keyline/operations/surface_pictures.h"

namespace keyline::operations {

using core::Result;
using figure::Drawing;
using surface::FieldKind;
using surface::PatchValue;
using surface::Surface;
using surface::SurfaceValue;

namespace {

constexpr std::size_t kMostPatchRows = 400;

std::string number(double x, int digits = 4) { return figure::short_number(x, digits); }

/// How far the nearest curve of one matrix lies and what it is worth, after the other cells.
void add_nearest_cells(const surface::NetworkValue& c, std::vector<std::string>& cells) {
  cells.push_back(c.nearest ? number(c.nearest->nearest.distance) : "");
  cells.push_back(c.nearest && c.nearest->value ? number(c.nearest->value->cav) : "");
}

std::vector<std::string> curve_row(const surface::NetworkValue& c) {
  const classa::CurveValue& v = c.value;
  const bool one = v.matrix.has_value();
  return {c.name,
          std::to_string(v.type),
          number(v.cav),
          one ? number(v.matrix->alpha) : "",
          one ? number(v.matrix->s) : "",
          v.minimum ? number(v.minimum->alpha) : "",
          v.minimum ? number(v.minimum->s) : "",
          std::isfinite(v.energy) ? number(v.energy) : "",
          v.minimum ? number(v.minimum->energy) : "",
          v.monotone.answer == curve::MonotoneVerdict::yes  ? "yes"
          : v.monotone.answer == curve::MonotoneVerdict::no ? "no"
                                                            : "undecided"};
}

report::ReportTable curve_table(const SurfaceValue& value, const std::string& caption) {
  using report::Alignment;
  report::ReportTable table;
  table.caption = caption;
  table.columns = {{"Curve", Alignment::text},
                   {"Type"},
                   {"CAV"},
                   {"α"},
                   {"s"},
                   {"α least"},
                   {"s least"},
                   {"Energy"},
                   {"Energy least"},
                   {"Monotone", Alignment::text}};
  const bool nearest = std::any_of(value.curves.begin(), value.curves.end(),
                                   [](const auto& c) { return c.nearest.has_value(); });
  if (nearest) {
    table.columns.push_back({"Nearest away"});
    table.columns.push_back({"CAV of nearest"});
  }
  for (const surface::NetworkValue& c : value.curves) {
    table.rows.push_back(curve_row(c));
    if (nearest) add_nearest_cells(c, table.rows.back());
  }
  return table;
}

report::ReportTable patch_table(const std::vector<PatchValue>& values) {
  report::ReportTable table;
  table.caption = "Surface aesthetic value by Bézier patch, counted along u and v";
  table.columns = {{"Patch", report::Alignment::text},
                   {"SAV"},
                   {"Worst curve", report::Alignment::text},
                   {"Its type"},
                   {"Its CAV"}};
  for (const PatchValue& p : values) {
    if (table.rows.size() == kMostPatchRows) break;
    const auto& worst = p.value.curves[p.value.worst];
    table.rows.push_back({fmt::format("{}, {}", p.row, p.column), number(p.value.sav), worst.name,
                          std::to_string(worst.value.type), number(worst.value.cav)});
  }
  return table;
}

const PatchValue& worst_patch(const std::vector<PatchValue>& values) {
  return *std::max_element(
      values.begin(), values.end(),
      [](const PatchValue& a, const PatchValue& b) { return a.value.sav < b.value.sav; });
}

/// Sum with the nearest curves in place of types 4 and 5; empty where one is missing.
std::optional<double> nearest_total(const std::vector<PatchValue>& values) {
  double sum = 0;
  for (const PatchValue& p : values)
    for (const auto& c : p.value.curves) {
      const bool beside = c.nearest && c.nearest->value;
      if (c.value.type > 3 && !beside) return std::nullopt;
      sum += c.value.type > 3 ? c.nearest->value->cav : c.value.cav;
    }
  return sum;
}

double total(const std::vector<PatchValue>& values) {
  double sum = 0;
  for (const PatchValue& p : values) sum += p.value.sav;
  return sum;
}

void set_verdict(const SurfaceSubject& subject, report::Report& report) {
  if (subject.values.empty()) {
    report.verdict = report::Verdict::caution;
    report.verdict_line = "No surface aesthetic value: " + subject.no_value + ".";
    return;
  }
  int beyond = 0;
  int all = 0;
  for (const PatchValue& p : subject.values)
    for (const auto& c : p.value.curves) {
      ++all;
      beyond += c.value.type > 2;
    }
  report.verdict = beyond == 0 ? report::Verdict::good : report::Verdict::caution;
  const auto& worst = worst_patch(subject.values).value;
  report.verdict_line =
      beyond == 0 ? "All network curves are Class A."
                  : fmt::format("{} of {} network curves are not Class A; the worst is {}.", beyond,
                                all, worst.curves[worst.worst].name);
}

const char* caption_of(const std::optional<FieldKind>& field) {
  if (!field) return "Lit, with lines of constant u and v";
  switch (*field) {
    case FieldKind::gaussian:
      return "Gaussian curvature, without the outer 2 % of its values";
    case FieldKind::mean:
      return "Mean curvature, positive towards S_u × S_v";
    case FieldKind::principal:
      return "The larger principal curvature";
    case FieldKind::zebra:
      return "Zebra: as continuous as the tangent plane";
    case FieldKind::isophote:
      return "Lines of equal brightness";
    case FieldKind::reflection:
      return "Parallel lamps reflected in the surface";
    case FieldKind::highlight:
      return "Where normals pass a lamp at equal distances";
  }
  return "";
}

Result<Drawing> shot_of(const std::vector<Surface>& surfaces, const std::optional<FieldKind>& field,
                        const SurfaceLook& look, const std::string& unit) {
  SurfacePicture picture;
  if (!field) picture.title = "Surface";
  picture.field = field;
  picture.unit = unit;
  picture.view = look.view;
  picture.stripe_count = look.stripe_count;
  picture.lighting = look.lighting;
  return surface_picture(surfaces, picture);
}

void set_head(const SurfaceSubject& subject, const ReportOptions& options, report::Report& report) {
  report.title = options.title.empty() ? "Surface: " + subject.name : options.title;
  report.subtitle = options.subtitle;
  report.options = options.options;
  report.command = options.command;
  report.generator = options.generator;
  const surface::PatchGrid grid = surface::patches_of(subject.surface);
  const surface::Net& net = grid.patches.front().net;
  if (!subject.values.empty()) {
    const auto& worst = worst_patch(subject.values).value;
    report.numbers = {{"SAV", number(total(subject.values)),
                       subject.values.size() > 1 ? "sum of all patches" : ""},
                      {"Worst curve", worst.curves[worst.worst].name,
                       fmt::format("type {}", worst.curves[worst.worst].value.type)}};
    if (const auto nearest = nearest_total(subject.values))
      report.numbers.insert(report.numbers.begin() + 1,
                            {"SAV of the nearest curves", number(*nearest), "of one matrix each"});
  }
  report.numbers.push_back({"Degrees", fmt::format("{} × {}", net.rows - 1, net.columns - 1), {}});
  report.numbers.push_back({"Bézier patches", std::to_string(grid.patches.size()), {}});
}

}  // namespace

Result<report::Report> surface_report(const SurfaceSubject& subject, const ReportOptions& options,
                                      const SurfaceLook& look) {
  report::Report report;
  set_head(subject, options, report);
  set_verdict(subject, report);
  if (subject.trims > 0)
    report.notes.push_back({report::NoteKind::note,
                            fmt::format("{}: {} edges cut a face out of this surface in the file; "
                                        "the whole surface is shown and valued.",
                                        subject.name, subject.trims)});
  report::Section pictures{"Surface", {}, {}, {}};
  for (const auto& shot : look.shots) {
    auto drawing = shot_of({subject.surface}, shot, look, options.unit);
    if (!drawing) return std::unexpected(drawing.error());
    pictures.figures.push_back({std::move(*drawing), caption_of(shot)});
  }
  report.sections.push_back(std::move(pictures));
  if (subject.values.empty()) return report;
  report::Section value{"Surface aesthetic value", {}, {}, {}};
  const PatchValue& worst = worst_patch(subject.values);
  const surface::PatchGrid grid = surface::patches_of(subject.surface);
  const auto& patch =
      grid.patches[static_cast<std::size_t>(worst.row) * grid.columns + worst.column];
  const std::string which = subject.values.size() > 1
                                ? fmt::format("Worst patch, {}, {}", worst.row, worst.column)
                                : "Network curves";
  value.figures.push_back({network_profiles(patch, which, options.unit),
                           "Curvature of the rows and columns of the control net"});
  if (subject.values.size() > 1) value.tables.push_back(patch_table(subject.values));
  value.tables.push_back(curve_table(worst.value, which));
  report.sections.push_back(std::move(value));
  if (subject.values.size() > kMostPatchRows)
    report.notes.push_back(
        {report::NoteKind::note,
         fmt::format("The table shows {} of {} patches.", kMostPatchRows, subject.values.size())});
  return report;
}

Result<Drawing> surface_page(const std::vector<SurfaceSubject>& subjects,
                             const ReportOptions& options, const SurfaceLook& look) {
  std::vector<Surface> all;
  for (const SurfaceSubject& s : subjects) all.push_back(s.surface);
  std::vector<Drawing> cells;
  for (const auto& shot : look.shots) {
    auto drawing = shot_of(all, shot, look, options.unit);
    if (!drawing) return drawing;
    cells.push_back(std::move(*drawing));
  }
  Drawing page = figure::tile(cells, std::min<int>(2, static_cast<int>(cells.size())));
  if (all.size() == 1) {
    const surface::PatchGrid grid = surface::patches_of(all.front());
    if (grid.patches.size() == 1 && !is_rational(grid.patches.front()))
      page = figure::stack(
          {page, network_profiles(grid.patches.front(), "Network curves", options.unit)});
  }
  page.title = options.title;
  return page;
}

namespace {

struct Pair {
  Drawing before;
  Drawing after;
};

/// Range of a curvature over both surfaces.
core::Interval common_range(const Surface& a, const Surface& b, FieldKind field) {
  core::Interval range{0, 0};
  bool first = true;
  for (const Surface* s : {&a, &b}) {
    const auto found = surface::interrogate(surface::sample_grid(*s, 65, 65), field);
    if (!found) continue;
    range.low = first ? found->range.low : std::min(range.low, found->range.low);
    range.high = first ? found->range.high : std::max(range.high, found->range.high);
    first = false;
  }
  return range;
}

/// The same picture of both, in the lights of the first and in the same colours.
Result<Pair> before_and_after(const Surface& given, const Surface& edited, FieldKind field,
                              const std::string& title, const std::string& unit) {
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
  auto after = surface_picture({edited}, picture);
  if (!after) return std::unexpected(after.error());
  return Pair{std::move(*before), std::move(*after)};
}

}  // namespace

Result<Drawing> surface_edit_page(const surface::BezierSurface& given,
                                  const surface::EditResult& edited, const ReportOptions& options) {
  std::vector<Drawing> cells;
  for (const auto& [field, title] :
       {std::pair{FieldKind::zebra, "Zebra"}, {FieldKind::mean, "Mean curvature"}}) {
    auto pair = before_and_after(given, edited.surface, field, title, options.unit);
    if (!pair) return std::unexpected(pair.error());
    cells.push_back(std::move(pair->before));
    cells.push_back(std::move(pair->after));
  }
  return figure::stack({figure::tile(cells, 2),
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

}  // namespace

Result<report::Report> surface_edit_report(const surface::BezierSurface& given,
                                           const surface::EditResult& edited,
                                           const ReportOptions& options) {
  report::Report report;
  report.title = options.title.empty() ? "Surface edit" : options.title;
  report.subtitle = options.subtitle;
  report.options = options.options;
  report.command = options.command;
  report.generator = options.generator;
  report.verdict = edited.after.sav <= 1 ? report::Verdict::good : report::Verdict::caution;
  report.verdict_line =
      fmt::format("SAV from {} to {}, {} from the given surface.", number(edited.before.sav),
                  number(edited.after.sav), number(edited.departure));
  report.numbers = {
      {"SAV before", number(edited.before.sav), {}},
      {"SAV after", number(edited.after.sav), {}},
      {"Largest departure",
       number(edited.departure) + (options.unit.empty() ? "" : "\u00A0" + options.unit),
       {}},
      {"Target", edited.target, fmt::format("{:.0f} %", 100 * edited.amount)}};
  for (const surface::MissedTarget& m : edited.missed)
    report.notes.push_back(
        {report::NoteKind::note,
         fmt::format("Target \"{}\" was not found. {}: {}.", m.target, m.curve, m.why)});
  for (const surface::MissedTarget& m : edited.unmet)
    report.notes.push_back(
        {report::NoteKind::note,
         fmt::format("Short of the target {} is outside its condition: {}.", m.curve, m.why)});
  auto page = surface_edit_page(given, edited, options);
  if (!page) return std::unexpected(page.error());
  report.sections.push_back({"Before and after",
                             {},
                             {{std::move(*page), "Zebra, mean curvature and network curves"}},
                             {}});
  report::ReportTable tradeoff{"What lower values cost: targets by departure",
                               {{"Target", report::Alignment::text}, {"Departure"}, {"SAV"}},
                               {}};
  for (const surface::TradeOff& t : edited.tradeoff)
    tradeoff.rows.push_back({t.name, number(t.departure), number(t.sav)});
  report.sections.push_back(
      {"Surface aesthetic value",
       {},
       {{tradeoff_chart(edited, options.unit), "SAV of each target against its departure"}},
       {curve_table(edited.before, "Network curves before"),
        curve_table(edited.after, "Network curves after"), std::move(tradeoff)}});
  return report;
}

}  // namespace keyline::operations
