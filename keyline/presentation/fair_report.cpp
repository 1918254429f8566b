#include "keyline/presentation/fair_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyline/analysis/rhythm.h"
#include "keyline/core/text.h"
#include "keyline/figure/curve_charts.h"
#include "keyline/figure/ticks.h"
#include "keyline/presentation/curve_samples.h"
#include "keyline/presentation/fair_joints.h"
#include "keyline/presentation/fair_marks.h"
#include "keyline/presentation/report_parts.h"

namespace keyline::presentation {
namespace {

using detail::length_text;
using fairing::FairPiece;
using fairing::FairResult;
using figure::SampledCurve;

constexpr std::size_t kMostPoints = 2000;
constexpr double kMostHeight = 480;  // of a figure, px
constexpr int kGraphSamples = 201;

/// Everything the sections are made of.
struct Material {
  const acquire::KeyLine& line;
  const FairResult& result;
  const FairReportOptions& options;
  core::Interval slopes;
  SampledCurve faired;
  SampledCurve spline;
  figure::ChartOptions chart;
};

std::string place_of(const Material& m, std::size_t index) {
  const core::Point2 p = m.line.points[index];
  return fmt::format("point {} at ({}, {})", index, figure::short_number(p.x, 6),
                     figure::short_number(p.y, 6));
}

std::size_t count_beyond(const FairResult& result) {
  return static_cast<std::size_t>(
      std::count_if(result.offsets.begin(), result.offsets.end(),
                    [&](double d) { return std::abs(d) > result.tolerance; }));
}

/// Points whose distances count: outside a region none do.
std::string measured_points(const FairResult& result) {
  const auto measured = std::count_if(result.offsets.begin(), result.offsets.end(),
                                      [](double d) { return !std::isnan(d); });
  return core::counted(static_cast<std::size_t>(measured), "point");
}

std::size_t kept_parts(const FairResult& result) {
  return static_cast<std::size_t>(std::count_if(
      result.curves.begin(), result.curves.end(),
      [](const auto& member) { return !std::holds_alternative<lac::Chain>(member); }));
}

std::string fairness_line(const fairing::FairFigures& f) {
  const char* whose = f.smoothing_spline ? "the smoothest spline within the tolerance"
                                         : "the spline through the points";
  if (f.fair) return fmt::format("Fair: as calm a comb as that of {}, or calmer.", whose);
  if (f.rivals.size() > 1)
    return fmt::format("Not fair: for {} of {} chains between corners {} has a calmer comb.",
                       f.unfair, f.rivals.size(), whose);
  const analysis::CombFigures& rival = f.rival();
  return fmt::format("Not fair: {} has a calmer comb ({}, variation {}, jolt {}).", whose,
                     core::counted(static_cast<std::size_t>(rival.waves), "wave"),
                     figure::short_number(rival.energy, 3), figure::short_number(rival.jolt, 2));
}

void set_verdict(const Material& m, report::Report& report) {
  const FairResult& r = m.result;
  const std::string& unit = m.options.unit;
  const std::string pieces = core::counted(r.pieces.size(), "piece");
  const std::string cut = r.cancelled ? " The work was cancelled; this is the best found." : "";
  if (r.within_tolerance) {
    const bool passed = r.fairness.fair && !r.cancelled;
    report.verdict = passed ? report::Verdict::good : report::Verdict::caution;
    report.verdict_line =
        fmt::format("Near enough: {} within {} of every point{}, curvature monotone in each. {}{}",
                    pieces, length_text(r.tolerance, unit),
                    kept_parts(r) > 0 ? " of the region" : "", fairness_line(r.fairness), cut);
    return;
  }
  report.verdict = report::Verdict::bad;
  const std::size_t beyond = count_beyond(r);
  report.verdict_line = fmt::format(
      "{} of {} lie{} beyond the tolerance of {}; the farthest is {}, {} off.{}", beyond,
      measured_points(r), beyond == 1 ? "s" : "", length_text(r.tolerance, unit),
      place_of(m, r.worst_point), length_text(r.max_deviation, unit), cut);
}

void set_numbers(const Material& m, report::Report& report) {
  const FairResult& r = m.result;
  const std::string& unit = m.options.unit;
  const std::size_t kept = kept_parts(r);
  int order = 3;
  const std::size_t chains = r.curves.size() - kept;
  for (const auto& joint : detail::chain_joints(r)) order = std::min(order, joint.joint.order);
  std::string shape = r.closed ? "closed" : "open";
  if (chains > 1) shape += fmt::format(", {} chains between corners", chains);
  if (kept > 0) shape += ", " + core::counted(kept, "part") + " kept as given";
  const analysis::CombFigures& comb = r.fairness.answer;
  const analysis::CombFigures& rival = r.fairness.rival();
  const auto beside = [&](const std::string& figure) {
    return figure +
           (r.fairness.smoothing_spline ? " of a spline as near" : " of the points' spline");
  };
  report.numbers = {
      {"Pieces", fmt::format("{}", r.pieces.size()), shape},
      {"Largest deviation", length_text(r.max_deviation, unit, 3),
       fmt::format("tolerance {}; at point {}", length_text(r.tolerance, unit, 3), r.worst_point)},
      {"Rms deviation", length_text(r.rms_deviation, unit, 3), "of " + measured_points(r)},
      {"Noise of the points", length_text(r.noise, unit, 3),
       r.noise > 0 ? "standard deviation, normal to the curve" : "none found"},
      {"Waves of curvature", fmt::format("{}", comb.waves), beside(fmt::format("{}", rival.waves))},
      {"Variation of curvature", figure::short_number(comb.energy, 3),
       beside(figure::short_number(rival.energy, 3))},
      {"Jolt", figure::short_number(comb.jolt, 2), beside(figure::short_number(rival.jolt, 2))},
      {"Length", length_text(r.length, unit), {}},
      {"Continuity", order < 0 ? "gap" : fmt::format("G{}", std::min(order, 3)),
       "lowest inside a chain"}};
  if (detail::chain_joints(r).empty()) report.numbers.pop_back();
  detail::let_units_wrap(report.numbers);
}

report::Section overlay_section(const Material& m) {
  const FairResult& r = m.result;
  report::Section section{"Before and after", {}, {}, {}};
  figure::Overlay overlay = detail::deviations(m.line.points, r.offsets, m.faired, kMostPoints);
  overlay.tolerance = r.tolerance;
  std::string caption =
      "Measured points and the faired curve; circles are the joints of its pieces. The comb shows "
      "how far each point lies off, exaggerated as stated.";
  if (overlay.points.size() < m.line.points.size())
    caption += fmt::format(" Of {} points {} are drawn, in every stretch the one farthest off.",
                           m.line.points.size(), overlay.points.size());
  section.figures.push_back({figure::overlay(overlay, m.chart), caption});
  return section;
}

const lac::Piece* lac_piece(const FairResult& result, const FairPiece& piece) {
  const auto* chain =
      std::get_if<lac::Chain>(&result.curves[static_cast<std::size_t>(piece.curve)]);
  return chain ? &chain->pieces[static_cast<std::size_t>(piece.piece)] : nullptr;
}

std::string rhythm_text(const FairPiece& piece, const lac::Piece* shape) {
  std::string text = analysis::rhythm_name(piece.rhythm);
  if (shape && shape->curvature_start * shape->curvature_end < 0) text += ", S-shaped";
  if (piece.overridden) text += " (as asked)";
  return text;
}

/// What is said of the sampled curve's pieces, kept parts among them.
std::vector<std::string> pieces_told(const Material& m) {
  std::vector<std::string> told;
  std::size_t next = 0;
  for (const std::string& name : m.faired.piece_names) {
    if (name == "kept" || next >= m.result.pieces.size()) {
      told.emplace_back("kept as given");
      continue;
    }
    const FairPiece& piece = m.result.pieces[next];
    told.push_back(
        fmt::format("piece {}: {}", next, rhythm_text(piece, lac_piece(m.result, piece))));
    const std::string slopes = detail::slopes_text(piece.slopes);
    if (!slopes.empty()) told.back() += " " + slopes;
    if (piece.told) told.back() += ", " + std::string(fairing::impression(piece));
    ++next;
  }
  return told;
}

report::Section curvature_section(const Material& m) {
  report::Section section{"Curvature", {}, {}, {}};
  std::vector<SampledCurve> curves{m.faired};
  if (!m.spline.points.empty()) curves.push_back(m.spline);
  section.figures.push_back(
      {figure::curvature_plot(curves, m.chart),
       "Curvature along the faired curve and, for comparison, along the spline through the points "
       "(stretched to the same length). Bands and numbers are the pieces, counted from 0.",
       true});
  SampledCurve marked = m.faired;
  detail::add_marks(marked, m.result, m.slopes);
  section.figures.push_back(
      {figure::curvature_comb(marked, m.chart),
       std::string("Curvature comb of the faired curve: a wobble would show here. ") +
           (marked.marks.empty() ? "" : detail::kMarksCaption),
       true});
  section.linked = report::LinkedCurve{m.faired, m.spline, pieces_told(m), m.options.unit};
  section.figures.push_back(
      {figure::evolute_chart(m.faired, m.chart),
       "Evolute of the faired curve, the locus of its centres of curvature. It runs to infinity at "
       "inflections and has a point where curvature is largest or smallest."});
  return section;
}

/// Arc length of every piece's start along the whole, kept parts included.
std::vector<double> piece_starts(const Material& m) {
  std::vector<double> starts;
  for (std::size_t i = 0; i < m.faired.piece_names.size(); ++i) {
    if (m.faired.piece_names[i] == "kept") continue;
    starts.push_back(i == 0 ? 0 : m.faired.arc_length[m.faired.joints[i - 1]]);
  }
  return starts;
}

/// Curvature at n equal steps along a piece.
analysis::CurvatureProfile profile_of(const lac::Piece& piece, int n) {
  analysis::CurvatureProfile profile;
  for (int i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / (n - 1);
    const double rate = lac::curvature_rate(piece, t);
    const double bend = lac::curvature(piece, t);
    if (!std::isfinite(rate) || !std::isfinite(bend)) continue;  // a cusp or a sharp inflection
    profile.arc_length.push_back(t * piece.length);
    profile.curvature.push_back(bend);
    profile.curvature_rate.push_back(rate);
  }
  return profile;
}

detail::PieceGraphs graphs_of(const Material& m, std::size_t index, double from) {
  const FairPiece& piece = m.result.pieces[index];
  detail::PieceGraphs graphs;
  graphs.name = fmt::format("Piece {}", index);
  graphs.length = piece.length;
  const lac::Piece* shape = lac_piece(m.result, piece);
  if (!shape || shape->curvature_start == shape->curvature_end) return graphs;
  graphs.lcg = analysis::logarithmic_curvature_graph(profile_of(*shape, kGraphSamples));
  const auto fine = analysis::complete(profile_of(*shape, 2 * analysis::kLddcPoints + 1));
  if (fine) graphs.lddc = analysis::curvature_distribution_diagram(*fine);
  const auto before =
      analysis::complete(detail::profile_between(m.spline, from, from + piece.length));
  if (!before) return graphs;
  graphs.before = analysis::logarithmic_curvature_graph(*before);
  graphs.before_lddc = analysis::curvature_distribution_diagram(*before);
  return graphs;
}

report::ReportTable piece_table(const Material& m) {
  using enum report::Alignment;
  const std::string& unit = m.options.unit;
  report::ReportTable table{"Pieces in order along the curve, counted from 0",
                            {{"Piece", number},
                             {"Rhythm", text},
                             {"Slope \u03B1", number},
                             {"Length", number},
                             {"Radius start \u2026 end", number},
                             {"Volume", number},
                             {"Deviation", number},
                             {"Impression", text},
                             {"Look at", text}},
                            {}};
  const auto marks = detail::piece_marks(m.result, m.slopes);
  for (std::size_t i = 0; i < m.result.pieces.size(); ++i) {
    const FairPiece& piece = m.result.pieces[i];
    const lac::Piece* shape = lac_piece(m.result, piece);
    table.rows.push_back(
        {fmt::format("{}", i), rhythm_text(piece, shape), detail::slopes_text(piece.slopes),
         length_text(piece.length, unit),
         shape ? detail::radii_text(shape->curvature_start, shape->curvature_end, unit) : "",
         detail::area_text(piece.volume, unit), length_text(piece.deviation, unit, 3),
         piece.told ? fairing::impression(piece) : "the points do not tell",
         detail::marks_text(marks[i])});
  }
  return table;
}

report::ReportTable reading_table(const FairResult& result) {
  using enum report::Alignment;
  report::ReportTable table{
      "How each piece may be read, with plausibility", {{"Piece", number}, {"Readings", text}}, {}};
  for (std::size_t i = 0; i < result.pieces.size(); ++i) {
    const std::string readings = detail::readings_text(result.pieces[i].interpretations);
    if (!readings.empty()) table.rows.push_back({fmt::format("{}", i), readings});
  }
  return table;
}

report::Section piece_section(const Material& m) {
  report::Section section{"Pieces and their rhythm", {}, {}, {}};
  section.paragraphs.push_back(
      "Pieces are numbered from 0, as --interpretation PIECE:RHYTHM and PIECE:slope=NUMBER count "
      "them.");
  report::ReportTable readings = reading_table(m.result);
  if (!readings.rows.empty())
    section.paragraphs.push_back(
        "The first table has the most plausible reading of every piece, the second what else the "
        "points allow: where two are nearly as plausible, the choice is the designer's. Pieces of "
        "fewer than five points, or whose slope may be any, tell nothing; shorter ones than a "
        "fiftieth of the line leave no impression.");
  section.tables.push_back(piece_table(m));
  if (!readings.rows.empty()) section.tables.push_back(std::move(readings));
  return section;
}

report::Section graph_section(const Material& m) {
  report::Section section{"Logarithmic curvature graphs and diagrams", {}, {}, {}};
  section.paragraphs.push_back(
      "A straight line in the graph (LCG) is a log-aesthetic curve, its slope \u03B1 the rhythm. "
      "The diagram (LDDC) shows how much of the length has which radius: A is its end at the "
      "smallest radius, B at the largest. Grey is the spline through the points over the same "
      "stretch.");
  const std::vector<double> starts = piece_starts(m);
  std::vector<detail::PieceGraphs> graphs;
  for (std::size_t i = 0; i < m.result.pieces.size() && i < starts.size(); ++i)
    graphs.push_back(graphs_of(m, i, starts[i]));
  detail::add_graphs(section, graphs);
  return section;
}

report::Section joint_section(const Material& m) {
  report::Section section{"Continuity", {}, {}, {}};
  std::vector<report::JointRow> rows;
  for (const auto& named : detail::named_joints(m.result))
    rows.push_back(detail::joint_row(named.between, named.joint, m.options.unit));
  if (rows.empty())
    section.paragraphs.push_back("One piece: nothing is joined.");
  else
    section.tables.push_back(report::joint_table(rows));
  return section;
}

void add_notes(const Material& m, report::Report& report) {
  const FairResult& r = m.result;
  const auto warn = [&](std::string text) {
    report.notes.push_back({report::NoteKind::warning, std::move(text)});
  };
  if (!r.within_tolerance)
    warn(fmt::format("{} beyond the tolerance; give a larger tolerance or look for strays near {}.",
                     core::counted(count_beyond(r), "point lies", "points lie"),
                     place_of(m, r.worst_point)));
  if (r.cancelled) warn("The work was cancelled before it was done.");
  for (std::size_t i = 0; i < r.pieces.size(); ++i)
    if (r.pieces[i].overridden)
      warn(fmt::format("Piece {}: the reading asked for replaces the one found.", i));
  for (const std::string& note : r.notes) report.notes.push_back({report::NoteKind::note, note});
}

void add_repeat(const Material& m, report::Report& report) {
  const auto add = [&](const char* name, std::string value) {
    const bool told = std::any_of(report.options.begin(), report.options.end(),
                                  [&](const auto& option) { return option.first == name; });
    if (!told) report.options.emplace_back(name, std::move(value));
  };
  add("tolerance", fmt::format("{}", m.result.tolerance));
  add("noise", fmt::format("{}", m.result.noise));
}

}  // namespace

report::Report fair_report(const acquire::KeyLine& line, const FairResult& result,
                           const FairReportOptions& options, core::Interval slopes) {
  if (line.points.size() != result.offsets.size())
    throw core::InvalidInput("fair_report: the result is of another key-line");
  const Material m{line,
                   result,
                   options,
                   slopes,
                   detail::faired_samples(result),
                   detail::spline_samples(result),
                   {.unit = options.unit, .largest_height = kMostHeight}};
  report::Report report =
      detail::headed(options, line.id.empty() ? "Faired key-line" : "Faired key-line " + line.id);
  set_verdict(m, report);
  set_numbers(m, report);
  report.sections = {overlay_section(m), curvature_section(m), piece_section(m), graph_section(m),
                     joint_section(m)};
  add_notes(m, report);
  add_repeat(m, report);
  return report;
}

}  // namespace keyline::presentation
