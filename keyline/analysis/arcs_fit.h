#pragma once

#include <vector>

#include "keyline/analysis/piece_frame.h"

namespace keyline::analysis::detail {

struct ArcsFit {
  std::vector<double> curvatures;
  std::vector<double> breaks;  ///< in (0, 1), growing
  double deviation = 0;
};

/// Least-squares fit of n circular arcs joined with common tangents (n = 1: a single arc).
ArcsFit fit_arcs(const PieceFrame& frame, int n);

}  // namespace keyline::analysis::detail
