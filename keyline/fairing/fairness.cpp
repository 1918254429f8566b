#include "keyline/fairing/fairness.h"

#include <algorithm>
#include <cmath>

#include "keyline/curve/concept.h"
#include "keyline/curve/length.h"
#include "keyline/fairing/fair.h"
#include "keyline/fit/smoothing_spline.h"
#include "keyline/lac/chain/chain_graph.h"

namespace keyline::fairing {
namespace {

constexpr int kPerSpline = 6000;  // even steps of a spline's parameter at which its comb is read
constexpr double kAsGood = 1.5;   // times another's figure: as calm to the eye

curve::CurvatureGraph graph_of(const lac::Chain& chain) { return lac::curvature_graph(chain); }

curve::CurvatureGraph graph_of(const curve::BSpline2& spline) {
  curve::CurvatureGraph graph;
  core::Point2 last = jet(spline, 0).point;
  double at = 0;
  for (int i = 0; i <= kPerSpline; ++i) {
    const curve::Jet2 here = jet(spline, static_cast<double>(i) / kPerSpline);
    at += core::distance(last, here.point);
    last = here.point;
    graph.arc_length.push_back(at);
    graph.curvature.push_back(curvature(here));
  }
  return graph;
}

void add(analysis::CombFigures& sum, const analysis::CombFigures& one) {
  sum.waves += one.waves;
  sum.energy = std::max(sum.energy, one.energy);
  sum.jolt = std::max(sum.jolt, one.jolt);
}

/// The points of an answer of one chain in its order: of a closed key-line that a corner parts,
/// from the corner on.
std::vector<core::Point2> points_along(const acquire::KeyLine& line, bool open) {
  std::vector<core::Point2> points = line.points;
  if (!line.closed || !open || line.corners.empty()) return points;
  const auto corner = points.begin() + static_cast<std::ptrdiff_t>(line.corners.front());
  std::rotate(points.begin(), corner, points.end());
  points.push_back(points.front());
  return points;
}

/// The splines that any answer is held against.
FairFigures rivals_of(const acquire::KeyLine& line, const FairResult& result, int threads) {
  FairFigures figures;
  for (const curve::BSpline2& spline : result.splines)
    add(figures.spline, analysis::comb_figures(graph_of(spline)));
  if (result.curves.size() != 1) return figures;
  const auto* chain = std::get_if<lac::Chain>(&result.curves.front());
  const bool open = chain ? !chain->closed : !result.closed;
  const auto smooth =
      fit::smoothing_spline_curvature(points_along(line, open), !open, result.tolerance, threads);
  if (smooth) figures.smoothing_spline = analysis::comb_figures(*smooth);
  return figures;
}

bool as_fair(const analysis::CombFigures& a, const analysis::CombFigures& b) {
  return a.waves <= b.waves && a.energy <= kAsGood * b.energy && a.jolt <= kAsGood * b.jolt;
}

}  // namespace

FairFigures fair_figures(const acquire::KeyLine& line, const FairResult& result,
                         const FairFigures* before, int threads) {
  FairFigures figures = before ? *before : rivals_of(line, result, threads);
  figures.answer = {};
  for (const FairCurve& member : result.curves)
    add(figures.answer,
        std::visit([](const auto& c) { return analysis::comb_figures(graph_of(c)); }, member));
  figures.fair =
      result.all_single || figures.answer.energy == 0 || as_fair(figures.answer, figures.rival());
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
