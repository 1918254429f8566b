#include "keyline/operations/curve_analyze.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/curve/monotone.h"
#include "keyline/document/cusped.h"
#include "keyline/fairing/points_splines.h"
#include "keyline/operations/diagram_shown.h"
#include "keyline/operations/ends.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/sampled_comb.h"

namespace keyline::operations {
namespace {

using analysis::MonotoneAnswer;
using core::Result;

MonotoneAnswer from_verdict(const curve::MonotoneVerdict& verdict) {
  switch (verdict.answer) {
    case curve::MonotoneVerdict::yes:
      return {MonotoneAnswer::Value::yes, 0};
    case curve::MonotoneVerdict::no:
      return {MonotoneAnswer::Value::no, verdict.witness};
    case curve::MonotoneVerdict::undecided:
      break;
  }
  return {MonotoneAnswer::Value::undecided, verdict.witness};
}

/// Curvature of a chain is monotone in every piece: only the sense may change at joints.
MonotoneAnswer certify_chain(const lac::Chain& chain) {
  double sense = 0;
  double at = 0;
  const double total = lac::arc_length(chain);
  const auto step = [&](double change, double t) {
    if (change == 0) return true;
    if (sense * change < 0) {
      at = t;
      return false;
    }
    sense = change;
    return true;
  };
  double s = 0;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const lac::Piece& piece = chain.pieces[i];
    if (i > 0 && !step(piece.curvature_start - chain.pieces[i - 1].curvature_end, s / total))
      return {MonotoneAnswer::Value::no, at};
    s += piece.length;
    if (!step(piece.curvature_end - piece.curvature_start, (s - 0.5 * piece.length) / total))
      return {MonotoneAnswer::Value::no, at};
  }
  return {MonotoneAnswer::Value::yes, 0};
}

std::function<MonotoneAnswer()> certificate_of(const document::Path& path) {
  if (path.curves.size() != 1) return {};
  const auto& value = path.curves[0].value;
  if (const auto* bezier = std::get_if<curve::Bezier2>(&value))
    return [bezier] { return from_verdict(curve::certify_monotone_curvature(*bezier)); };
  if (const auto* spline = std::get_if<curve::BSpline2>(&value))
    return [spline] { return from_verdict(curve::certify_monotone_curvature(*spline)); };
  if (const auto* chain = std::get_if<lac::Chain>(&value))
    return [chain] { return certify_chain(*chain); };
  return {};
}

/// Numbers of the public form are finite.
std::optional<double> finite(double x) {
  return std::isfinite(x) ? std::optional(x) : std::nullopt;
}

std::vector<Event> events_of(const std::vector<analysis::CurvatureEvent>& found) {
  using Kind = analysis::CurvatureEvent::Kind;
  std::vector<Event> events;
  for (const analysis::CurvatureEvent& e : found) {
    events.push_back({e.t, e.arc_length, finite(e.curvature), {}});
    if (e.kind == Kind::maximum) events.back().kind = EventKind::maximum;
    if (e.kind == Kind::minimum) events.back().kind = EventKind::minimum;
  }
  return events;
}

LcgGraph graph_of(const analysis::Lcg& lcg) {
  LcgGraph graph;
  if (lcg.defined) {
    graph.slope = lcg.slope;
    graph.intercept = lcg.intercept;
    graph.variance = lcg.variance;
  }
  for (const auto& p : lcg.points) graph.points.push_back({p.log_radius, p.log_rate});
  return graph;
}

AnalyzedPiece piece_shown(const analysis::PieceAnalysis& piece) {
  return {piece.extent.t,
          piece.extent.arc_length,
          {finite(piece.extent.curvature_start), finite(piece.extent.curvature_end)},
          piece.length,
          piece.volume,
          piece.rhythm,
          piece.slopes,
          piece.impression,
          graph_of(piece.lcg),
          shown(piece.lddc),
          readings_of(piece.interpretations)};
}

/// Points are analysed through their splines, as in steps 2 to 4 of fairing.
Result<document::Path> splines_of(const acquire::KeyLine& line, const AnalyzeRequest& request,
                                  const Context& context) {
  fit::SplineFitOptions options = fit::SplineFitOptions::for_fairing();
  options.seed = request.seed;
  options.threads = context.threads;
  options.rounding = line.rounding;
  options.progress = context.progress;
  auto splines = fairing::splines_of(line, options);
  if (!splines) return std::unexpected(splines.error());
  document::Path path;
  for (curve::BSpline2& spline : *splines) path.curves.push_back({std::move(spline)});
  path.closed = line.closed;
  return path;
}

Result<AnalyzeAnswer> run(const AnalyzeRequest& request, const Context& context) {
  const Subject& subject = request.subject;
  auto line = measured_line(subject, context.progress.cancellation);
  if (!line) return std::unexpected(std::move(line.error()));
  const bool polygon = subject.curve && *line && !are_points_of_a_curve((**line).points);
  if (!*line || polygon) {
    if (auto extent = check_extent(*subject.curve); !extent) return std::unexpected(extent.error());
    auto found = analyze_path(*subject.curve, subject.acquiring.noise.value_or(0),
                              request.plot_samples, context.progress);
    if (!found) return std::unexpected(found.error());
    AnalyzeAnswer answer = analyze_answer(std::move(*found));
    answer.unused = unused_of(subject, line->has_value());
    std::erase(answer.unused, "noise");  // it is the curve's here
    answer.path = *subject.curve;
    answer.comb = comb_figures_of(answer.path);
    return answer;
  }
  auto spline = splines_of(**line, request, context);
  if (!spline) return std::unexpected(std::move(spline.error()));
  auto found = analyze_path(*spline, (**line).noise, request.plot_samples, context.progress);
  if (!found) return std::unexpected(found.error());
  AnalyzeAnswer answer = analyze_answer(std::move(*found));
  answer.unused = unused_of(subject, true);
  answer.noise = (**line).noise;
  answer.spline = *spline;
  answer.path = std::move(*spline);
  answer.comb = comb_figures_of(answer.path);
  return answer;
}

}  // namespace

LddcGraph shown(const analysis::Lddc& lddc) {
  LddcGraph graph;
  for (const auto& bar : lddc.bars)
    if (bar.count > 0) graph.bars.push_back({bar.low, bar.count, bar.height});
  for (const auto& top : lddc.c_curve) graph.c_curve.push_back({top.x, top.y});
  if (lddc.has_gradient) graph.gradient = lddc.gradient;
  graph.noise_tops = lddc.tops.size() - lddc.c_curve.size();
  if (lddc.c_curve.empty()) return graph;
  graph.a = {lddc.a.x, lddc.a.y};
  graph.b = {lddc.b.x, lddc.b.y};
  graph.distance_ab = lddc.distance_ab;
  return graph;
}

AnalyzeAnswer analyze_answer(analysis::CurveAnalysis analysis) {
  AnalyzeAnswer answer;
  answer.length = analysis.length;
  answer.volume = analysis.volume;
  answer.curvature.min = finite(analysis.curvature_min);
  answer.curvature.max = finite(analysis.curvature_max);
  for (const auto& p : analysis.plot) answer.curvature.plot.push_back({p.arc_length, p.curvature});
  answer.inflections = events_of(analysis.split.inflections);
  answer.extrema = events_of(analysis.split.extrema);
  answer.corners = events_of(analysis.split.corners);
  for (const auto& wave : analysis.split.merged)
    answer.merged.push_back({wave.t, wave.displacement});
  answer.threshold = analysis.split.threshold;
  for (const auto& piece : analysis.pieces) answer.pieces.push_back(piece_shown(piece));
  answer.monotone = verdict_of(analysis.monotone.value);
  if (answer.monotone != Verdict::yes) answer.witness = analysis.monotone.witness;
  answer.analysis = std::move(analysis);
  return answer;
}

analysis::MonotoneAnswer certified_monotone(const document::Path& path) {
  const auto certify = certificate_of(path);
  return certify ? certify() : MonotoneAnswer{MonotoneAnswer::Value::undecided, 0};
}

core::Result<analysis::CurveAnalysis> analyze_path(const document::Path& path, double noise,
                                                   int plot_samples,
                                                   const core::Progress& progress) {
  if (!(noise >= 0))
    return core::fail(core::ErrorCode::bad_input, "the noise is negative", "give 0 or more",
                      "noise");
  analysis::AnalyzeOptions options;
  options.noise = noise;
  options.one_end = kOneEnd;
  options.plot_samples = plot_samples;
  options.progress = progress;
  options.certify = certificate_of(path);
  const document::CuspedPath cusped(path);
  auto found = analysis::analyze(analysis::CurveView(cusped), options);
  if (!found) return found;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (document::has_cusp(cusped.stops(), 1)) found->curvature_max = kInfinity;
  if (document::has_cusp(cusped.stops(), -1)) found->curvature_min = -kInfinity;
  return found;
}

Operation curve_analyze_operation() {
  return declare<run>(
      {.name = "curve.analyze",
       .summary = "Length, volume, curvature, inflections, monotone pieces with their rhythm, "
                  "logarithmic curvature graph and diagram, and whether curvature is monotone. "
                  "Points are analysed through their spline.",
       .examples = {R"({"curve":{"type":"bezier","points":[[0,0],[2,0],[3,1],[3,3]]}})"},
       .long_running = true});
}

}  // namespace keyline::operations
