#include "keyline/curve/monotone.h"
#include "keyline/operations/analysis_json.h"
#include "keyline/operations/analyze_report.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using analysis::MonotoneAnswer;

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

core::Result<nlohmann::json> run(const nlohmann::json& request, const Context&) {
  const document::Path path = path_of(request, "curve");
  const double noise = number_or(request, "noise", 0);
  const auto plot = integer_between(request, "plot_samples", 401, 2, 1'000'000);
  if (!plot) return std::unexpected(plot.error());
  const auto found = analyze_path(path, noise, *plot);
  if (!found) return std::unexpected(found.error());
  return curve_analysis_json(*found);
}

}  // namespace

analysis::MonotoneAnswer certified_monotone(const document::Path& path) {
  const auto certify = certificate_of(path);
  return certify ? certify() : MonotoneAnswer{MonotoneAnswer::Value::undecided, 0};
}

core::Result<analysis::CurveAnalysis> analyze_path(const document::Path& path, double noise,
                                                   int plot_samples) {
  if (!(noise >= 0))
    return core::fail(core::ErrorCode::bad_input, "the noise is negative", "give 0 or more",
                      "noise");
  analysis::AnalyzeOptions options;
  options.noise = noise;
  options.plot_samples = plot_samples;
  options.certify = certificate_of(path);
  return path.curves.size() == 1 ? analysis::analyze(path.curves[0], options)
                                 : analysis::analyze(path, options);
}

Operation curve_analyze_operation() {
  using Type = Field::Type;
  return {
      "curve.analyze",
      "Length, volume, curvature, inflections, monotone pieces with their rhythm, logarithmic "
      "curvature graph and diagram, and whether curvature is monotone.",
      {{"curve", Type::curve, true, "any planar curve or path"},
       {"noise", Type::number, false,
        "standard deviation of the curve's positions; smaller waves are merged"},
       {"plot_samples", Type::integer, false, "points of the curvature plot, 401 unless given"}},
      run,
      {{"curve", {{"type", "bezier"}, {"points", {{0, 0}, {1, 0}, {2, 0.3}, {2.6, 1.2}}}}}}};
}

}  // namespace keyline::operations
