#include "keyline/fairing/assemble.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "keyline/core/text.h"
#include "keyline/curve/length.h"
#include "keyline/fairing/joint_rates.h"
#include "keyline/fairing/reading.h"
#include "keyline/fairing/runs.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kSameSlope = 1e-9;
constexpr int kSettleRounds = 8;  // Newton steps of a foot: digits double from step to step

/// The chain as laid out, in the form the fit takes, without feet.
FitChain as_fit_chain(const lac::Chain& chain) {
  FitChain out;
  out.closed = chain.closed;
  const std::vector<core::Pose2> poses = lac::joints(chain);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool last = i + 1 == poses.size();
    const lac::Piece& piece = chain.pieces[last ? i - 1 : i];
    out.joints.push_back({poses[i].position, poses[i].direction,
                          last ? piece.curvature_end : piece.curvature_start});
  }
  for (const lac::Piece& piece : chain.pieces)
    out.pieces.push_back({.length = piece.length, .alpha = piece.alpha});
  return out;
}

}  // namespace

std::vector<PointPlace> place_points(const RunResult& result, const Run& run) {
  FitChain chain = as_fit_chain(result.chain);
  const int last = static_cast<int>(chain.pieces.size()) - 1;
  std::vector<FitPoint> points;
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    Foot foot = result.fit.feet[result.point_of[j]];
    if (result.reversed) foot = {last - foot.piece, 1 - foot.fraction};
    chain.feet.push_back(foot);
    points.push_back({.position = run.points[j]});
  }
  const std::vector<double> offset = settle_feet(chain, points, kSettleRounds);
  std::vector<PointPlace> places(points.size());
  for (std::size_t j = 0; j < points.size(); ++j)
    places[j] = {offset[j], chain.feet[j].piece, chain.feet[j].fraction};
  return places;
}

void add_run(FairResult& result, const RunResult& solved, const Run& run, int curve, double start,
             const std::vector<int>& asked) {
  const std::vector<PointPlace> places = place_points(solved, run);
  std::vector<int> count(solved.chain.pieces.size(), 0);
  std::vector<double> deviation(solved.chain.pieces.size(), 0);
  double square = 0;
  std::size_t measured = 0;
  for (std::size_t j = 0; j < places.size(); ++j) {
    if (run.index[j] == Run::none) continue;
    ++measured;
    const PointPlace& place = places[j];
    ++count[place.piece];
    square += place.offset * place.offset;
    deviation[place.piece] = std::max(deviation[place.piece], std::abs(place.offset));
    double& kept = result.offsets[run.index[j]];
    if (!(std::abs(place.offset) < std::abs(kept)))
      kept = std::isnan(place.offset) ? HUGE_VAL : place.offset;
  }
  const double rms = std::sqrt(square / static_cast<double>(measured));
  std::vector<FairPiece> pieces =
      pieces_of(solved.chain, std::max(result.noise, rms), count, asked);
  for (FairPiece& piece : pieces) {
    piece.curve = curve;
    piece.start += start;
    piece.deviation = deviation[piece.piece];
    result.pieces.push_back(std::move(piece));
  }
}

void measure_deviation(FairResult& result) {
  double square = 0;
  std::size_t measured = 0;
  result.max_deviation = 0;
  for (std::size_t j = 0; j < result.offsets.size(); ++j) {
    if (std::isnan(result.offsets[j])) continue;
    ++measured;
    const double d = std::abs(result.offsets[j]);
    square += d * d;
    if (d <= result.max_deviation) continue;
    result.max_deviation = d;
    result.worst_point = j;
  }
  result.rms_deviation = std::sqrt(square / static_cast<double>(measured));
  result.within_tolerance = result.max_deviation <= result.tolerance;
}

void assemble(FairResult& result, const std::vector<RunResult>& solved,
              const AnswerMembers& members) {
  std::vector<int> curve_of;  // of each run
  const auto add_run = [&] {
    const std::size_t k = curve_of.size();
    curve_of.push_back(static_cast<int>(result.curves.size()));
    result.curves.push_back(solved[k].chain);
  };
  for (const auto& kept : members)
    if (kept)
      result.curves.push_back(*kept);
    else
      add_run();
  while (curve_of.size() < solved.size()) add_run();
  for (FairPiece& piece : result.pieces) piece.curve = curve_of[piece.curve];
  result.length = 0;
  for (const FairCurve& c : result.curves)
    result.length += std::visit([](const auto& v) { return arc_length(v); }, c);
  const auto calm = [](const RunResult& run) { return !run.dense.joints.empty(); };
  result.calm_missed =
      std::ranges::none_of(solved, calm) && std::ranges::any_of(solved, &RunResult::calm_missed);
  result.all_single = result.curves.size() == solved.size() &&
                      std::ranges::all_of(solved, [](const RunResult& run) {
                        return run.exact && run.chain.pieces.size() == 1;
                      });
  std::vector<analysis::CurveView> views;
  for (const FairCurve& c : result.curves)
    views.push_back(std::visit([](const auto& v) { return analysis::view(v); }, c));
  for (std::size_t i = 0; i < result.curves.size(); ++i) {
    const auto* chain = std::get_if<lac::Chain>(&result.curves[i]);
    if (!chain) continue;
    const std::vector<lac::Segment> segments = lac::segments(*chain);
    const auto inner = analysis::continuity(segments, chain->closed);
    result.joints.insert(result.joints.end(), inner.begin(), inner.end());
    count_rates(result.joint_rates, segments, chain->closed);
  }
  if (views.size() > 1) {
    const auto outer = analysis::continuity(views, result.closed);
    result.joints.insert(result.joints.end(), outer.begin(), outer.end());
  }
}

void note_of_run(FairResult& result, std::size_t k, std::size_t runs, const std::string& text) {
  result.notes.push_back(runs > 1 ? fmt::format("run {}: {}", k, text) : text);
}

void note_slopes(FairResult& result, core::Interval slopes) {
  const core::Interval usual = FairOptions{}.slopes;
  if (slopes.low == usual.low && slopes.high == usual.high) return;
  const auto other = std::ranges::count_if(result.pieces, [&](const FairPiece& piece) {
    return std::ranges::any_of(piece.slopes, [&](double slope) {
      return slope < slopes.low - kSameSlope || slope > slopes.high + kSameSlope;
    });
  });
  if (other > 0)
    result.notes.push_back(core::counted(static_cast<std::size_t>(other),
                                         "piece has a slope outside the range asked for",
                                         "pieces have slopes outside the range asked for"));
}

void note_run(FairResult& result, const RunResult& run, std::size_t k, std::size_t runs) {
  const auto note = [&](const std::string& text) { note_of_run(result, k, runs, text); };
  const std::string pieces = core::counted(run.chain.pieces.size(), "piece");
  note(pieces + ", " +
       (run.dense.joints.empty() ? fmt::format("merged from {}", run.start_pieces)
                                 : "read off the graph of curvature"));
  if (run.exact)
    note(
        "the points are reproduced to rounding, so the chain that does so is given rather than a "
        "shorter one");
  if (run.calm_missed)
    note(
        "the calmest chain did not come out within the tolerance, or wandered off between points, "
        "so the shortest one is given");
  if (run.waves.untried)
    note("more waves of curvature than can be tried one by one; some stay that might have gone");
  if (run.straightened > 0)
    note(core::counted(run.straightened, "piece is an exact line or arc",
                       "pieces are exact lines or arcs"));
}

}  // namespace keyline::fairing::detail
