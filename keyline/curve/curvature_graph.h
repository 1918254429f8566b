#pragma once

#include <vector>

namespace keyline::curve {

/// Curvature along a curve, by arc length, in order.
struct CurvatureGraph {
  std::vector<double> arc_length;
  std::vector<double> curvature;
};

/// L^3 * integral of (d curvature / ds)^2 of the straight lines between the samples, L from the
/// first to the last: the scale-free variation of [Moreton 1992].
///
/// Precondition: as many curvatures as arc lengths, at least one, arc lengths never falling.
double variation(const CurvatureGraph& graph);

}  // namespace keyline::curve
