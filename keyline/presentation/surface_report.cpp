#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

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
using surface::PatchValue;
using surface::Surface;
using surface::SurfaceValue;

namespace {

std::string number(double x) { return figure::short_number(x, 4); }

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

void set_numbers(const SurfaceSubject& subject, report::Report& report) {
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
  report::Report report = detail::headed(options, "Surface: " + subject.name);
  set_numbers(subject, report);
  set_verdict(subject, report);
  if (subject.trims > 0)
    report.notes.push_back(
        {report::NoteKind::note, fmt::format("{}: {} a face out of this surface in the file; "
                                             "the whole surface is shown and valued.",
                                             subject.name,
                                             core::counted(static_cast<std::size_t>(subject.trims),
                                                           "edge cuts", "edges cut"))});
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
  if (subject.values.size() > 1) value.tables.push_back(surface_patch_table(subject.values));
  value.tables.push_back(surface_curve_table(worst.value, which));
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

}  // namespace keyline::presentation
