#include "keyline/curve/curvature_graph.h"

#include <cmath>

namespace keyline::curve {

double variation(const CurvatureGraph& graph) {
  double sum = 0;
  for (std::size_t i = 1; i < graph.arc_length.size(); ++i) {
    const double step = graph.arc_length[i] - graph.arc_length[i - 1];
    if (step > 0) sum += std::pow(graph.curvature[i] - graph.curvature[i - 1], 2) / step;
  }
  return sum * std::pow(graph.arc_length.back() - graph.arc_length.front(), 3);
}

}  // namespace keyline::curve
