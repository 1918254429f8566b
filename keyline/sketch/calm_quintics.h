#pragma once

#include <vector>

#include "keyline/core/point.h"
#include "keyline/curve/bezier.h"

namespace keyline::sketch {

/// A chain of quintics whose curvature has the hand's waves no longer.
struct CalmQuintics {
  std::vector<curve::Bezier2> pieces;
  std::vector<core::Point2> line;  ///< places that the chain goes through or that it follows
};

/// The calmest chain within `most` of the points (fit::fit_quintic_chain). Comes back empty where
/// it has not fewer waves of curvature than `given`, or as many and less change of curvature
/// (analysis::comb_figures): then there was nothing to calm. Open ones keep their ends.
/// Precondition: no two neighbours equal; `given` is not empty.
CalmQuintics calm_quintics(const std::vector<core::Point2>& points, bool closed, double most,
                           const std::vector<curve::Bezier2>& given);

/// The points moved, none by more than 0.8 of `most`, towards a curvature (of every point, 1 /
/// their unit): smoothed by their third differences (Whittaker 1923 with the order of a smoothing
/// spline of degree 5), which are to be those of a line of that curvature, then followed by
/// quintics within a twentieth. Empty where no chain follows them. Precondition: points about
/// evenly spaced, no two neighbours equal; as many curvatures as points.
CalmQuintics quintics_towards(const std::vector<core::Point2>& points, bool closed, double most,
                              const std::vector<double>& curvature);

/// Waves of the chain's curvature, as analysis::comb_figures counts them.
int waves_of(const std::vector<curve::Bezier2>& pieces);

}  // namespace keyline::sketch
