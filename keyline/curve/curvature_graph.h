#pragma once

#include <vector>

namespace keyline::curve {

/// Curvature along a curve, by arc length, in order.
struct CurvatureGraph {
  std::vector<double> arc_length;
  std::vector<double> curvature;
};

}  // namespace keyline::curve
