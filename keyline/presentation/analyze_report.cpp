#include "keyline/presentation/analyze_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyline/analysis/continuity.h"
#include "keyline/core/text.h"
#include "keyline/figure/curve_charts.h"
#include "keyline/figure/ticks.h"
#include "keyline/operations/joints_inside.h"
#include "keyline/operations/sampled_comb.h"
#include "keyline/presentation/curve_samples.h"
#include "keyline/presentation/report_parts.h"

namespace keyline::presentation {
namespace {

using analysis::CurveAnalysis;
using analysis::MonotoneAnswer;
using analysis::PieceAnalysis;
using detail::length_text;

void set_verdict(const CurveAnalysis& a, report::Report& report) {
  using enum MonotoneAnswer::Value;
  const std::size_t n = a.pieces.size();
  const std::string parts = core::counted(n, "monotone piece");
  switch (a.monotone.value) {
    case yes:
      report.verdict = report::Verdict::good;
      report.verdict_line = "Curvature is monotone along the whole curve, which is certain.";
      return;
    case no:
      report.verdict = report::Verdict::caution;
      report.verdict_line =
          fmt::format("Curvature is not monotone: it turns near parameter {:.4f}; {}.",
                      a.monotone.witness, parts);
      return;
    case undecided:
      break;
  }
  report.verdict = report::Verdict::caution;
  report.verdict_line =
      "No change of sense was found in the curvature, but there is no certificate for this kind "
      "of curve; " +
      parts + ".";
}

void set_numbers(const CurveAnalysis& a, const analysis::CombFigures& comb, const std::string& unit,
                 report::Report& report) {
  const auto per_length = [&](double value) {
    return figure::short_number(value, 3) + (unit.empty() ? "" : "\u00A01/" + unit);
  };
  const double tightest = std::max(std::abs(a.curvature_min), std::abs(a.curvature_max));
  report.numbers = {
      {"Length", length_text(a.length, unit), {}},
      {"Volume", detail::area_text(a.volume, unit), "between curve and chord"},
      {"Curvature", per_length(a.curvature_min), "to " + per_length(a.curvature_max)},
      {"Smallest radius", tightest > 0 ? length_text(1 / tightest, unit) : "straight", {}},
      {"Inflections", fmt::format("{}", a.split.inflections.size()), {}},
      {"Extrema of curvature", fmt::format("{}", a.split.extrema.size()), {}},
      {"Waves of curvature", fmt::format("{}", comb.waves), "above 2 % of its range"},
      {"Variation of curvature", figure::short_number(comb.energy, 3), {}},
      {"Jolt", figure::short_number(comb.jolt, 2), {}},
      {"Corners", fmt::format("{}", a.split.corners.size()), {}}};
  detail::let_units_wrap(report.numbers);
}

std::vector<std::string> pieces_told(const CurveAnalysis& a) {
  std::vector<std::string> told;
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    told.push_back(fmt::format("piece {}: {}", i, analysis::rhythm_name(a.pieces[i].rhythm)));
    const std::string slopes = detail::slopes_text(a.pieces[i].slopes);
    if (!slopes.empty()) told.back() += " " + slopes;
  }
  return told;
}

report::Section curvature_section(const CurveAnalysis& a, const figure::SampledCurve& curve,
                                  const std::string& unit) {
  const figure::ChartOptions chart{.unit = unit, .largest_height = 480};
  report::Section section{"Curvature", {}, {}, {}};
  section.figures = {
      {figure::curvature_plot({curve}, chart),
       "Curvature along the curve. Bands and numbers are the monotone pieces, counted from 0.",
       true},
      {figure::curvature_comb(curve, chart), "Curvature comb.", true},
      {figure::evolute_chart(curve, chart),
       "Evolute, the locus of the centres of curvature. It runs to infinity at inflections."}};
  section.linked = report::LinkedCurve{.curve = curve, .pieces = pieces_told(a), .unit = unit};
  return section;
}

report::Section piece_section(const CurveAnalysis& a, const std::string& unit) {
  using enum report::Alignment;
  report::ReportTable table{"Monotone pieces in order along the curve, counted from 0",
                            {{"Piece", number},
                             {"Rhythm", text},
                             {"Slope \u03B1", number},
                             {"Length", number},
                             {"Radius start \u2026 end", number},
                             {"Volume", number},
                             {"A to B", number},
                             {"Impression", text}},
                            {}};
  report::ReportTable readings{
      "How each piece may be read, with plausibility", {{"Piece", number}, {"Readings", text}}, {}};
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    const PieceAnalysis& p = a.pieces[i];
    table.rows.push_back(
        {fmt::format("{}", i), analysis::rhythm_name(p.rhythm), detail::slopes_text(p.slopes),
         length_text(p.length, unit),
         detail::radii_text(p.extent.curvature_start, p.extent.curvature_end, unit),
         detail::area_text(p.volume, unit),
         p.lddc.c_curve.size() > 1 ? figure::short_number(p.lddc.distance_ab, 3) : "",
         p.impression});
    readings.rows.push_back({fmt::format("{}", i), detail::readings_text(p.interpretations)});
  }
  return {"Pieces and their rhythm", {}, {}, {std::move(table), std::move(readings)}};
}

report::Section graph_section(const CurveAnalysis& a) {
  report::Section section{"Logarithmic curvature graphs and diagrams", {}, {}, {}};
  section.paragraphs.push_back(
      "A straight line in the graph (LCG) is a log-aesthetic curve, its slope \u03B1 the rhythm. "
      "The diagram (LDDC) shows how much of the length has which radius: A is its end at the "
      "smallest radius, B at the largest.");
  std::vector<detail::PieceGraphs> graphs;
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    detail::PieceGraphs one;
    one.name = fmt::format("Piece {}", i);
    one.length = a.pieces[i].length;
    one.lddc = a.pieces[i].lddc;
    one.lcg = a.pieces[i].lcg;
    graphs.push_back(std::move(one));
  }
  detail::add_graphs(section, graphs);
  return section;
}

report::Section joint_section(const document::Path& path, const std::string& unit) {
  report::Section section{"Continuity where the curve's own pieces meet", {}, {}, {}};
  std::vector<report::JointRow> rows;
  for (const auto& [t, joint] : operations::joints_inside(path)) {
    const std::string at = fmt::format("({}, {})", figure::short_number(joint.position.x, 5),
                                       figure::short_number(joint.position.y, 5));
    rows.push_back(detail::joint_row(at, joint, unit));
  }
  if (rows.empty())
    section.paragraphs.push_back("One piece: nothing is joined.");
  else
    section.tables.push_back(report::joint_table(rows));
  return section;
}

void add_notes(const CurveAnalysis& a, const std::string& unit, report::Report& report) {
  if (!a.split.merged.empty())
    report.notes.push_back(
        {report::NoteKind::note,
         fmt::format("{} of curvature that move the curve by less than {} were taken for "
                     "noise and merged.",
                     core::counted(a.split.merged.size(), "wave"),
                     length_text(a.split.threshold, unit, 3))});
  for (const auto& corner : a.split.corners)
    report.notes.push_back(
        {report::NoteKind::note,
         fmt::format("Corner at arc length {}.", length_text(corner.arc_length, unit))});
}

}  // namespace

report::Report analyze_report(const CurveAnalysis& analysis, const document::Path& path,
                              const AnalyzeReportOptions& options) {
  report::Report report = detail::headed(options, "Analysis of a curve");
  set_verdict(analysis, report);
  set_numbers(analysis, operations::comb_figures_of(path), options.unit, report);
  const figure::SampledCurve curve = detail::path_samples(path, analysis.split.pieces);
  report.sections = {curvature_section(analysis, curve, options.unit),
                     piece_section(analysis, options.unit), graph_section(analysis),
                     joint_section(path, options.unit)};
  add_notes(analysis, options.unit, report);
  return report;
}

}  // namespace keyline::presentation
