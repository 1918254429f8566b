#include "keyline/operations/fair.h"

#include <algorithm>
#include <cmath>

#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

document::Path splines_of(const fairing::FairResult& result) {
  document::Path path{{}, result.closed && result.splines.size() > 1};
  for (const auto& spline : result.splines) path.curves.push_back({spline});
  return path;
}

std::vector<SplinePiece> monotone_pieces(const fairing::FairResult& result) {
  std::vector<SplinePiece> pieces;
  for (std::size_t i = 0; i < result.monotone.size(); ++i) {
    const analysis::MonotonePiece& m = result.monotone[i];
    pieces.push_back(
        {result.monotone_spline[i], m.t, m.arc_length, {m.curvature_start, m.curvature_end}});
  }
  return pieces;
}

/// Indices of points as given to indices in the key-line, which may be in another order and have
/// lost some.
core::Result<std::vector<std::size_t>> indices_in(const acquire::KeyLine& line,
                                                  const std::vector<std::size_t>& wanted) {
  std::vector<std::size_t> found;
  for (const std::size_t index : wanted) {
    const auto at = std::find(line.sources.begin(), line.sources.end(), index);
    if (!line.sources.empty() && at == line.sources.end())
      return core::fail(
          core::ErrorCode::bad_input, "point " + std::to_string(index) + " is not in the key-line",
          "it may have been dropped as stray or repeated; see keep_strays", "must_pass");
    found.push_back(line.sources.empty() ? index
                                         : static_cast<std::size_t>(at - line.sources.begin()));
  }
  return found;
}

core::Result<FairAnswer> run(const FairRequest& request, const Context& context) {
  auto measured = measured_line(request.subject, context.progress.cancellation);
  if (!measured) return std::unexpected(std::move(measured.error()));
  auto line = *measured ? core::Result<acquire::KeyLine>(**measured)
                        : sampled_line(*request.subject.curve, request.options.tolerance);
  if (!line) return std::unexpected(std::move(line.error()));
  fairing::FairOptions options = request.options;
  // [Fairing]'s plain search: random first knots, no polish.
  if (options.spline.knots == fit::KnotPlacement::ga) options.spline.smart_start = false;
  auto indices = indices_in(*line, options.must_pass);
  if (!indices) return std::unexpected(indices.error());
  options.must_pass = std::move(*indices);
  options.threads = context.threads;
  options.progress = context.progress;
  auto result = fairing::fair(*line, options);
  if (!result) return std::unexpected(result.error());
  FairAnswer answer = fair_answer(std::move(*line), std::move(*result));
  answer.unused = unused_of(request.subject, measured->has_value());
  return answer;
}

}  // namespace

document::Path fair_curve(const fairing::FairResult& result) {
  document::Path path{{}, result.closed};
  for (const auto& c : result.curves)
    path.curves.push_back(std::visit([](const auto& v) { return document::PlanarCurve{v}; }, c));
  return path;
}

FairAnswer fair_answer(acquire::KeyLine line, fairing::FairResult result) {
  FairAnswer answer;
  answer.curve.curve = simplest(fair_curve(result));
  answer.spline = splines_of(result);
  answer.spline_bic = result.spline_bic;
  answer.monotone_pieces = monotone_pieces(result);
  for (const fairing::FairPiece& piece : result.pieces)
    answer.pieces.push_back(
        {piece, fairing::impression(piece), readings_of(piece.interpretations)});
  answer.length = result.length;
  answer.noise = result.noise;
  answer.tolerance = result.tolerance;
  answer.deviation = {result.max_deviation, result.rms_deviation, result.worst_point};
  answer.within_tolerance = result.within_tolerance;
  answer.symmetry = result.symmetry;
  if (std::isfinite(result.rate)) answer.rate = result.rate;
  answer.outside = result.outside;
  answer.smoothness = result.smoothness;
  answer.fairness = result.fairness;
  answer.cancelled = result.cancelled;
  for (const auto& joint : result.joints) answer.continuity.push_back(joint_of(joint));
  answer.joints = result.joint_rates;
  answer.report = result.notes;
  answer.line = std::move(line);
  answer.faired = std::move(result);
  return answer;
}

Operation fair_operation() {
  return declare<run>(
      {.name = "fair",
       .summary = "The main job: a key-line's points (or a curve) in, a faired chain of "
                  "log-aesthetic pieces out, G2 at its joints, the calmest within the "
                  "tolerance.",
       .examples = {R"({"points":[[0,0],[0.1,0.004],[0.2,0.016],[0.3,0.036],[0.4,0.064],[0.5,0.1],
                [0.6,0.144],[0.7,0.196],[0.8,0.256],[0.9,0.324],[1,0.4],[1.1,0.484],[1.2,0.576],
                [1.3,0.676],[1.4,0.784],[1.5,0.9],[1.6,1.024],[1.7,1.156],[1.8,1.296],
                [1.9,1.444],[2,1.6]]})"},
       .long_running = true});
}

}  // namespace keyline::operations
