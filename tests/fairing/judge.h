#pragma once

#include <string>
#include <vector>

#include "keyline/fairing/fair.h"

/// A second opinion on the answer, from the chain's own numbers and nothing the solver said.
namespace keyline::fairing::testing {

struct Judgement {
  int pieces = 0;
  double curvature_jump = 0;  ///< largest at a joint inside a chain, relative
  double gap = 0;             ///< of closed chains and between curves, part of the length
  double turn_gap = 0;        ///< of closed chains' directions at the seam, radians
  double deviation = 0;       ///< largest distance of a point from the nearest curve
  double length_ratio = 0;    ///< chains to polygon
  double turning = 0;         ///< total absolute turning of the chains
  bool monotone = true;
  std::string fault;  ///< first thing that is wrong; empty: nothing
};

/// Looks at everything; the length ratio and the turning are only told.
Judgement judge(const FairResult& result, const std::vector<core::Point2>& points);

}  // namespace keyline::fairing::testing
