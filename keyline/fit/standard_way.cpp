#include "keyline/fit/standard_way.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "keyline/core/point.h"

namespace keyline::fit::detail {

bool goes_back(const curve::PiecewiseBezier& chain) {
  std::vector<double> edges;
  for (const curve::Bezier2& piece : chain.pieces)
    for (std::size_t i = 1; i < piece.control.size(); ++i)
      edges.push_back(core::distance(piece.control[i - 1], piece.control[i]));
  for (std::size_t i = 0; i < edges.size() / 2; ++i) {
    const double other = edges[edges.size() - 1 - i];
    if (std::abs(edges[i] - other) > 1e-9 * other) return edges[i] < other;
  }
  return false;
}

curve::PiecewiseBezier on_the_way_back(curve::PiecewiseBezier chain) {
  std::reverse(chain.pieces.begin(), chain.pieces.end());
  for (curve::Bezier2& piece : chain.pieces)
    std::reverse(piece.control.begin(), piece.control.end());
  return chain;
}

std::vector<CurvatureTarget> on_the_way_back(std::vector<CurvatureTarget> targets) {
  std::reverse(targets.begin(), targets.end());
  for (CurvatureTarget& t : targets) t = {1 - t.t, -t.curvature};
  return targets;
}

}  // namespace keyline::fit::detail
