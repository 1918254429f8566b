#include "keyline/curve/spline_graph.h"

#include "keyline/curve/concept.h"

namespace keyline::curve {
namespace {

constexpr int kSteps = 6000;  // a comb's narrowest peak that counts spans dozens of them

}  // namespace

CurvatureGraph curvature_graph(const BSpline2& spline) {
  CurvatureGraph graph;
  core::Point2 last = evaluate(spline, 0);
  double length = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const Jet2 here = jet(spline, static_cast<double>(i) / kSteps);
    length += core::distance(last, here.point);
    last = here.point;
    graph.arc_length.push_back(length);
    graph.curvature.push_back(curvature(here));
  }
  return graph;
}

}  // namespace keyline::curve
