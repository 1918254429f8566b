#include "keyline/fairing/fairness.h"

#include <algorithm>
#include <cmath>

#include "keyline/curve/concept.h"
#include "keyline/curve/length.h"
#include "keyline/curve/spline_graph.h"
#include "keyline/fairing/calm.h"
#include "keyline/fairing/corner_points.h"
#include "keyline/fairing/fair.h"
#include "keyline/fairing/flat_pieces.h"
#include "keyline/fairing/runs.h"
#include "keyline/fit/few_knots.h"
#include "keyline/fit/smoothing_spline.h"
#include "keyline/lac/chain/chain_graph.h"

namespace keyline::fairing {
namespace {

constexpr double kAsGood = 1.5;  // times another's figure: as calm to the eye

curve::CurvatureGraph graph_of(const lac::Chain& chain) { return lac::curvature_graph(chain); }

curve::CurvatureGraph graph_of(const curve::BSpline2& spline) {
  return curve::curvature_graph(spline);
}

analysis::CombFigures sum_of(const std::vector<analysis::CombFigures>& all) {
  analysis::CombFigures sum;
  for (const analysis::CombFigures& one : all) {
    sum.waves += one.waves;
    sum.energy = std::max(sum.energy, one.energy);
    sum.jolt = std::max(sum.jolt, one.jolt);
  }
  return sum;
}

/// Whether a member was faired; others are kept as given.
bool is_chain(const FairCurve& member) { return std::holds_alternative<lac::Chain>(member); }

/// The points of each member of the answer; nothing where parts of a given curve are kept.
std::vector<detail::Run> runs_of_members(const acquire::KeyLine& line, const FairResult& result) {
  if (result.curves.empty() || !std::ranges::all_of(result.curves, is_chain)) return {};
  const bool open = !std::get<lac::Chain>(result.curves.front()).closed;
  const bool cut = result.curves.size() > 1 || (line.closed && open);
  std::vector<detail::Run> runs = detail::smooth_runs(line, cut);
  if (runs.size() != result.curves.size()) return {};
  detail::meet_between_points(runs, result.tolerance, line.closed);
  return runs;
}

/// Of the smoothest spline; its waves are no more than those of a spline of few knots, which does
/// not ripple. Nothing where the first is not found.
std::optional<analysis::CombFigures> smooth_rival(const detail::Run& run, double tolerance,
                                                  int threads) {
  const auto smooth = fit::smoothing_spline_curvature(run.points, run.closed, tolerance, threads);
  if (!smooth) return std::nullopt;
  analysis::CombFigures figures = analysis::comb_figures(*smooth);
  if (const auto few = fit::few_knots_curvature(run.points, run.closed, tolerance))
    figures.waves = std::min(figures.waves, analysis::comb_figures(*few).waves);
  return figures;
}

/// The splines that any answer is held against.
FairFigures rivals_of(const acquire::KeyLine& line, const FairResult& result, int threads) {
  FairFigures figures;
  std::vector<analysis::CombFigures> splines;
  for (const curve::BSpline2& spline : result.splines)
    splines.push_back(analysis::comb_figures(graph_of(spline)));
  figures.spline = sum_of(splines);
  if (!std::ranges::all_of(result.curves, is_chain)) figures.rivals = splines;
  std::vector<analysis::CombFigures> found;
  for (const detail::Run& run : runs_of_members(line, result)) {
    const auto smooth = smooth_rival(run, result.tolerance, threads);
    if (smooth) found.push_back(*smooth);
    figures.rivals.push_back(smooth ? found.back() : figures.spline);
  }
  if (!found.empty()) figures.smoothing_spline = sum_of(found);
  return figures;
}

/// Holds a member, or all together, against a rival; energy that is unseen is none.
void hold(FairFigures& figures, const analysis::CombFigures& member,
          const analysis::CombFigures& rival, double unseen) {
  if (member.energy <= unseen) return;
  const double times = std::max(member.energy / rival.energy, member.jolt / rival.jolt);
  figures.waves_over += std::max(0, member.waves - rival.waves);
  figures.times = std::max(figures.times, times);
  const double most = member.waves < rival.waves ? detail::kWaveWorth : kAsGood;
  if (!(member.waves <= rival.waves && times <= most)) ++figures.unfair;
}

}  // namespace

FairFigures fair_figures(const acquire::KeyLine& line, const FairResult& result,
                         const FairFigures* before, int threads) {
  FairFigures figures = before ? *before : rivals_of(line, result, threads);
  figures.unfair = 0;
  figures.waves_over = 0;
  figures.times = 0;
  std::vector<analysis::CombFigures> members;
  std::vector<double> unseen;  // energies
  for (const FairCurve& member : result.curves) {
    const auto* chain = std::get_if<lac::Chain>(&member);
    if (!chain) continue;
    const curve::CurvatureGraph graph = graph_of(*chain);
    members.push_back(analysis::comb_figures(graph));
    unseen.push_back(detail::unseen_energy(graph.arc_length.back(), result.tolerance));
  }
  figures.answer = sum_of(members);
  const bool each = figures.rivals.size() == members.size();
  for (std::size_t k = 0; each && k < members.size(); ++k)
    hold(figures, members[k], figures.rivals[k], unseen[k]);
  if (!each) hold(figures, figures.answer, figures.rival(), 0);
  figures.fair = result.all_single || figures.unfair == 0;
  return figures;
}

std::vector<analysis::CombMark> comb_marks(const FairResult& result) {
  std::vector<analysis::CombMark> marks;
  double from = 0;
  for (const FairCurve& member : result.curves) {
    const auto* chain = std::get_if<lac::Chain>(&member);
    if (!chain) {
      from += curve::arc_length(std::get<curve::BSpline2>(member));
      continue;
    }
    for (analysis::CombMark mark : analysis::comb_marks(graph_of(*chain))) {
      mark.at += from;
      marks.push_back(mark);
    }
    from += lac::arc_length(*chain);
  }
  return marks;
}

}  // namespace keyline::fairing
