#pragma once

#include <vector>

#include "keyline/core/point.h"
#include "keyline/curve/bezier.h"

namespace keyline::sketch {

/// A chain of quintics whose curvature has the hand's waves no longer.
struct CalmQuintics {
  std::vector<curve::Bezier2> pieces;
  std::vector<core::Point2> line;  ///< the points without their waves, that the chain follows
};

/// The points smoothed by their third differences as far as none moves by more than 0.8 of `most`
/// (Whittaker 1923 with the order of a smoothing spline of degree 5: what is least is the change of
/// curvature), then followed by as few quintics as a tenth of `most` takes, G2 at all joints. Comes
/// back empty where no such chain has fewer waves of curvature than `given`, or as many and less
/// change of curvature (analysis::comb_figures): then there was nothing to calm.
///
/// The chain lies within `most` of the points. Open ones keep their ends.
/// Precondition: points about evenly spaced, no two neighbours equal; `given` is not empty.
CalmQuintics calm_quintics(const std::vector<core::Point2>& points, bool closed, double most,
                           const std::vector<curve::Bezier2>& given);

/// The points moved, none by more than `most`, towards a curvature (of every point, 1 / their
/// unit): as calm_quintics, with the third differences of a line of that curvature in place of 0.
/// Empty where no chain of quintics follows them. Same preconditions; as many curvatures as points.
CalmQuintics quintics_towards(const std::vector<core::Point2>& points, bool closed, double most,
                              const std::vector<double>& curvature);

/// Waves of the chain's curvature, as analysis::comb_figures counts them.
int waves_of(const std::vector<curve::Bezier2>& pieces);

}  // namespace keyline::sketch
