#include "keyline/analysis/analyze.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "keyline/analysis/seam.h"
#include "keyline/analysis/volume.h"
#include "keyline/numeric/parallel.h"

namespace keyline::analysis {
namespace {

core::Result<void> check(const CurveView& curve, double length) {
  for (double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    if (!core::is_finite(curve.jet_at(t).point))
      return core::fail(core::ErrorCode::bad_input, "the curve holds a number that is not finite",
                        "check its control points");
  }
  if (!std::isfinite(length) || !(length > 0))
    return core::fail(core::ErrorCode::bad_input, "the curve has no length",
                      "give it two different points");
  return {};
}

std::vector<CurvaturePlotPoint> plot_of(const CurveView& curve, const ArcLengthTable& table,
                                        int samples) {
  std::vector<CurvaturePlotPoint> plot;
  const int n = std::max(samples, 2);
  for (int i = 0; i < n; ++i) {
    const double s = table.length() * i / (n - 1);
    const double t = i == 0 ? 0 : i == n - 1 ? 1 : table.parameter_at(s);
    const double kappa = curve::curvature(curve.jet_at(t));
    if (std::isfinite(kappa)) plot.push_back({t, s, kappa});
  }
  return plot;
}

core::Result<PieceAnalysis> analyze_piece(const CurveView& curve, const ArcLengthTable& table,
                                          const MonotonePiece& extent,
                                          const AnalyzeOptions& options, double whole) {
  PieceAnalysis piece;
  piece.extent = extent;
  piece.length = extent.arc_length.high - extent.arc_length.low;
  piece.volume = volume(curve, extent.t);
  const CurvatureProfile fine = sample_profile(curve, table, extent.t, 2 * kLddcPoints + 1);
  piece.lddc = curvature_distribution_diagram(fine);
  piece.lcg = logarithmic_curvature_graph(
      sample_profile(curve, table, extent.t, std::max(options.piece_samples, 3)));
  RhythmOptions rhythm = options.rhythm;
  rhythm.noise = std::max(rhythm.noise, options.noise);
  // Measurements are spread over the whole curve; a piece has its share of them.
  rhythm.observations = std::max(10.0, rhythm.observations * piece.length / whole);
  auto reading = classify_rhythm(fine, rhythm);
  if (!reading) return std::unexpected(reading.error());
  piece.interpretations = std::move(reading->interpretations);
  const Interpretation& best = piece.interpretations.front();
  piece.rhythm = best.rhythm;
  piece.slopes = best.slopes;
  piece.impression = impression(best.rhythm);
  return piece;
}

MonotoneAnswer monotone_answer(const AnalyzeOptions& options, const Split& split) {
  if (options.certify) return options.certify();
  if (!split.extrema.empty()) return {MonotoneAnswer::Value::no, split.extrema.front().t};
  return {};
}

core::Result<std::vector<PieceAnalysis>> analyze_pieces(const CurveView& curve,
                                                        const ArcLengthTable& table,
                                                        std::vector<MonotonePiece> extents,
                                                        const AnalyzeOptions& options) {
  std::erase_if(extents, [&](const MonotonePiece& e) {
    return !(e.arc_length.high - e.arc_length.low > 1e-12 * table.length());
  });
  std::vector<std::optional<core::Result<PieceAnalysis>>> found(extents.size());
  std::mutex telling;
  double begun = 0;
  numeric::parallel_for(extents.size(), options.threads, [&](std::size_t i) {
    if (options.progress.stop_requested()) return;
    {
      const std::scoped_lock lock(telling);
      options.progress.report(begun++ / static_cast<double>(extents.size()), "analysing pieces");
    }
    found[i] = analyze_piece(curve, table, extents[i], options, table.length());
  });
  std::vector<PieceAnalysis> pieces;
  for (auto& piece : found) {
    if (!piece) return core::fail(core::ErrorCode::cancelled, "cancelled");
    if (!*piece) return std::unexpected(piece->error());
    pieces.push_back(std::move(**piece));
  }
  return pieces;
}

}  // namespace

core::Result<CurveAnalysis> analyze(const CurveView& curve, const AnalyzeOptions& options) {
  const ArcLengthTable table(curve);
  if (const auto sound = check(curve, table.length()); !sound)
    return std::unexpected(sound.error());
  CurveAnalysis result;
  result.length = table.length();
  result.volume = volume(curve);
  result.plot = plot_of(curve, table, options.plot_samples);
  SplitOptions split = options.split;
  split.noise = std::max(split.noise, options.noise);
  result.split = split_monotone(curve, split);
  auto pieces = analyze_pieces(curve, table, result.split.pieces, options);
  if (!pieces) return std::unexpected(pieces.error());
  result.pieces = std::move(*pieces);
  result.curvature_min = std::numeric_limits<double>::infinity();
  result.curvature_max = -result.curvature_min;
  const auto meet = [&](double kappa) {
    if (!std::isfinite(kappa)) return;
    result.curvature_min = std::min(result.curvature_min, kappa);
    result.curvature_max = std::max(result.curvature_max, kappa);
  };
  for (const CurvaturePlotPoint& p : result.plot) meet(p.curvature);
  for (const MonotonePiece& p : result.split.pieces) {
    meet(p.curvature_start);
    meet(p.curvature_end);
  }
  result.monotone = monotone_answer(options, result.split);
  const double apart = core::distance(curve.point(0), curve.point(1));
  if (options.one_end && apart <= *options.one_end * table.length())
    add_events_at_seam(curve, table, split, result.split);
  return result;
}

}  // namespace keyline::analysis
