#include "keyline/lac/chain/chain_graph.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::lac {

curve::CurvatureGraph curvature_graph(const Chain& chain, int per_piece) {
  curve::CurvatureGraph graph;
  double at = 0;
  for (const Segment& segment : segments(chain)) {
    for (int i = 0; i <= per_piece; ++i) {
      const double share = 0.5 * (1 - std::cos(core::kPi * i / per_piece));
      graph.arc_length.push_back(at + share * segment.length);
      graph.curvature.push_back(curvature(segment, share));
    }
    at += segment.length;
  }
  return graph;
}

double fastest_rate(const Chain& chain) {
  double most = 0;
  for (const Piece& piece : chain.pieces) {
    if (piece.curvature_start * piece.curvature_end <= 0 && piece.alpha < -1 &&
        piece.curvature_start != piece.curvature_end)
      return HUGE_VAL;
    for (const double end : {0.0, 1.0}) most = std::max(most, std::abs(curvature_rate(piece, end)));
  }
  return most;
}

}  // namespace keyline::lac
