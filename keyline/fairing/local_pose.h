#pragma once

#include <vector>

#include "keyline/fairing/chain_fit.h"

namespace keyline::fairing::detail {

/// Points with their chord-length position; closed curves can be read past either end.
struct Track {
  const std::vector<FitPoint>& points;
  std::vector<double> position;
  double total = 0;
  bool closed = false;

  core::Point2 point(long i) const;
  double at(long i) const;
};
Track make_track(const std::vector<FitPoint>& points, bool closed);

/// Pose and curvature at chord length s: a parabola through the points within `reach`, at least
/// five of them.
FitJoint local_pose(const Track& track, double s, double reach);

}  // namespace keyline::fairing::detail
