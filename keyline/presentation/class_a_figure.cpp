#include "keyline/presentation/class_a_figure.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyline/curve/length.h"
#include "keyline/figure/curve_charts.h"
#include "keyline/operations/class_a_plane.h"
#include "keyline/operations/verdict.h"
#include "keyline/presentation/pages.h"
#include "keyline/presentation/report_parts.h"

namespace keyline::presentation {

using core::Point2;
using figure::Drawing;

namespace {

figure::Grid energy_grid(const operations::ClassAPlane& field) {
  figure::Grid grid{{field.alpha.low, field.s.low}, {field.alpha.high, field.s.high}};
  grid.rows = static_cast<int>(field.energy.size());
  grid.columns = static_cast<int>(field.energy.front().size());
  for (const auto& row : field.energy)
    grid.values.insert(grid.values.end(), row.begin(), row.end());
  return grid;
}

struct ShownPlace {
  std::optional<classa::ControlMatrix> place;
  bool nearest = false;
};

ShownPlace shown_place(const classa::Evaluation& e) {
  if (e.value.matrix) return {e.value.matrix};
  if (e.nearest_value && e.nearest_value->matrix) return {e.nearest_value->matrix, true};
  return {};
}

/// Range of s that shows the Class A boundary and all that is to be seen.
core::Interval shown_scales(const std::vector<PlaneEntry>& curves, const Point2* minimum,
                            const std::vector<Point2>& path) {
  core::Interval s{0.4, 2.4};
  const auto add = [&s](double value) {
    s.low = std::min(s.low, 0.9 * value);
    s.high = std::max(s.high, 1.1 * value);
  };
  for (const PlaneEntry& entry : curves)
    if (const auto shown = shown_place(*entry.evaluation); shown.place) add(shown.place->s);
  if (minimum) add(minimum->y);
  for (const Point2& p : path) add(p.y);
  return {std::max(s.low, 0.05), std::min(s.high, 20.0)};
}

figure::SampledCurve sampled(const std::string& name, const curve::Bezier2& c) {
  constexpr int kSamples = 401;
  figure::SampledCurve samples;
  samples.name = name;
  double length = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double t = i / (kSamples - 1.0);
    const curve::Jet2 j = jet(c, t);
    if (i > 0) length += curve::arc_length(c, (i - 1) / (kSamples - 1.0), t, 1e-6);
    samples.arc_length.push_back(length);
    samples.points.push_back(j.point);
    samples.tangent_angle.push_back(curve::tangent_angle(j));
    samples.curvature.push_back(curve::curvature(j));
  }
  return samples;
}

std::string number(double value) { return fmt::format("{:.4g}", value); }

std::string place_text(const classa::CurveValue& v) {
  return v.matrix ? fmt::format("α {:.4f}, s {:.4f}", v.matrix->alpha, v.matrix->s) : "none";
}

std::vector<Drawing> edit_drawings(const classa::EditResult& edited,
                                   const classa::Approximation& given,
                                   const classa::EditOptions& options,
                                   const ReportOptions& report) {
  const figure::ChartOptions chart{.unit = report.unit, .largest_height = 460};
  const auto before = sampled("before", given.curve);
  const auto after = sampled("after", edited.curve);
  classa::Evaluation before_place{given, edited.before, {}, {}};
  classa::Evaluation after_place{{edited.curve, true}, edited.after, {}, {}};
  std::vector<PlaneEntry> places;
  if (before_place.value.matrix) places.push_back({"before", &before_place});
  places.push_back({"after", &after_place});
  return {
      figure::before_after_chart({before, after, given.curve.control, edited.curve.control}, chart),
      figure::curvature_plot({after, before}, chart),
      plane_chart(places, options.cav, edited.path)};
}

}  // namespace

Drawing plane_chart(const std::vector<PlaneEntry>& curves, const classa::CavOptions& options,
                    const std::vector<Point2>& path) {
  figure::AlphaSPlane plane;
  plane.alpha_max = options.alpha_max;
  plane.path = path;
  std::optional<Point2> minimum;
  if (!curves.empty() && curves.front().evaluation->value.minimum) {
    const classa::EnergyMinimum& m = *curves.front().evaluation->value.minimum;
    minimum = Point2{m.alpha, m.s};
  }
  plane.s = shown_scales(curves, minimum ? &*minimum : nullptr, path);
  if (minimum) plane.points.push_back({"minimum", minimum->x, minimum->y, figure::Marker::cross});
  for (const PlaneEntry& entry : curves) {
    const ShownPlace shown = shown_place(*entry.evaluation);
    if (!shown.place) continue;
    plane.points.push_back({entry.name + (shown.nearest ? " (nearest)" : ""), shown.place->alpha,
                            shown.place->s,
                            shown.nearest ? figure::Marker::circle : figure::Marker::dot});
  }
  if (curves.empty()) return figure::alpha_s_chart(plane);
  const classa::Evaluation& first = *curves.front().evaluation;
  const auto reading = classa::read_curve(first.approximation.curve, options);
  if (reading && first.value.degree >= 2 && norm(reading->conditions.chord) > 0) {
    operations::ClassAPlane field = operations::class_a_plane(*reading, options.alpha_max, plane.s);
    plane.energy = energy_grid(field);
    plane.reach = std::move(field.reach);
  }
  plane.subtitle =
      fmt::format("degree {}: {}", first.value.degree, type_in_words(first.value.type));
  return figure::alpha_s_chart(plane);
}

Drawing edit_picture(const classa::EditResult& edited, const classa::Approximation& given,
                     const classa::EditOptions& options, const ReportOptions& report) {
  Drawing page = figure::stack(edit_drawings(edited, given, options, report));
  page.title = report.title.empty() ? "Edited curve" : report.title;
  return page;
}

namespace {

/// Title, command and the options the edit was made with.
report::Report edit_head(const classa::EditOptions& options, const ReportOptions& report) {
  report::Report r = detail::headed(report, "Edited curve");
  r.options.push_back({"amount", number(options.amount)});
  r.options.push_back({"largest alpha", number(options.cav.alpha_max)});
  r.options.push_back({"end tolerance", options.cav.end_tolerance
                                            ? number(*options.cav.end_tolerance)
                                            : std::string("0.01 of the chord")});
  if (options.target)
    r.options.push_back({"target", fmt::format("α {}, s {}", number(options.target->alpha),
                                               number(options.target->s))});
  return r;
}

}  // namespace

report::Report edit_report(const classa::EditResult& edited, const classa::Approximation& given,
                           const classa::EditOptions& options, const ReportOptions& report) {
  report::Report r = edit_head(options, report);
  const bool good = edited.after.type <= 2;
  r.verdict = good ? report::Verdict::good : report::Verdict::caution;
  r.verdict_line = fmt::format("CAV from {} to {}: {}.", number(edited.before.cav),
                               number(edited.after.cav), type_in_words(edited.after.type));
  r.numbers = {{"CAV before", number(edited.before.cav), type_in_words(edited.before.type)},
               {"CAV after", number(edited.after.cav), type_in_words(edited.after.type)},
               {"Strain energy before", number(edited.before.energy), {}},
               {"Strain energy after", number(edited.after.energy), {}},
               {"Place before", place_text(edited.before), {}},
               {"Place after", place_text(edited.after), {}},
               {"Monotone curvature before",
                std::string(core::word_of(operations::verdict_of(edited.before.monotone.answer))),
                {}},
               {"Monotone curvature after",
                std::string(core::word_of(operations::verdict_of(edited.after.monotone.answer))),
                {}}};
  std::vector<Drawing> drawings = edit_drawings(edited, given, options, report);
  r.sections = {{"Curves", {}, {{drawings[0], "Curves with their control polygons."}}, {}},
                {"Curvature", {}, {{drawings[1], "Curvature along both curves."}}, {}},
                {"The α–s plane",
                 {"Shaded: Class A. Contours: strain energy of curves of this degree with this "
                  "chord. Dotted: curves with these ends and this start tangent."},
                 {{drawings[2], "From the given curve to the edited one."}},
                 {}}};
  if (!given.exact)
    r.notes.push_back({report::NoteKind::note,
                       fmt::format("The curve was approximated by a Bézier curve of degree {} "
                                   "within {}.",
                                   curve::degree(given.curve), number(given.deviation))});
  return r;
}

report::Section class_a_section(const std::vector<PlaneEntry>& curves, std::size_t index,
                                const classa::CavOptions& options) {
  std::vector<PlaneEntry> shown = curves;
  std::swap(shown.front(), shown.at(index));
  const classa::Evaluation& e = *shown.front().evaluation;
  const classa::CurveValue& v = e.value;
  report::ReportTable table{
      "Curve aesthetic value", {{"", report::Alignment::text}, {"", report::Alignment::text}}, {}};
  table.rows = {{"Type", type_in_words(v.type)},
                {"CAV", number(v.cav)},
                {"Place in the plane", place_text(v)},
                {"Strain energy", std::isfinite(v.energy) ? number(v.energy) : "infinite"},
                {"Minimum-energy point",
                 v.minimum ? fmt::format("α {:.4f}, s {:.4f}, energy {:.4g}", v.minimum->alpha,
                                         v.minimum->s, v.minimum->energy)
                           : v.no_minimum},
                {"Degree", fmt::format("{}", v.degree)}};
  if (!e.approximation.exact)
    table.rows.push_back({"Approximated within", number(e.approximation.deviation)});
  if (e.nearest)
    table.rows.push_back(
        {"Nearest curve with one matrix",
         fmt::format("{} away{}", number(e.nearest->distance),
                     e.nearest_value ? ", CAV " + number(e.nearest_value->cav) : "")});
  return {"Class A",
          {"After Oya, Hanafusa and Aoyama: 0 is the Class A curve of least strain energy."},
          {{plane_chart(shown, options),
            "Place in the α–s plane; shaded is Class A. Minimum and contours belong to the first "
            "curve named."}},
          {table}};
}

std::string type_in_words(int type) {
  constexpr const char* kWords[] = {"at the minimum", "Class A", "one matrix outside Class A",
                                    "several matrices", "no matrix"};
  return fmt::format("type {}, {}", type, kWords[std::clamp(type, 1, 5) - 1]);
}

}  // namespace keyline::presentation
