#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "keyline/core/interval.h"
#include "keyline/core/point.h"

/// The drawable region as a hand meets it: where a handle may stand while the other two stay.
namespace keyline::lac {

/// Chord angles that can be met turning by theta, 0 < theta < pi: drawable_region of some slope or
/// rhythm.
using RegionOfTurning = std::function<core::Interval(double theta)>;

struct HandleRegion {
  /// Where the handle may stand, turning left and turning right: closed polygons (the last point is
  /// followed by the first) that end at 50 times the distance of the other two handles.
  std::array<std::vector<core::Point2>, 2> outlines;
  /// Where the handle does not stand in them: the nearest place that does, a little inside, so that
  /// curvature is still finite there. Found to about 1e-6 of the other handles' distance.
  std::optional<core::Point2> nearest;
};

/// The triangle P0, P1, P2 has the angles psi, pi - theta and theta - psi; the two handles that
/// stay and two angles are all of it.
///
/// Precondition: `handle` in 0 … 2. Empty outlines where the other two handles coincide.
HandleRegion handle_region(const std::array<core::Point2, 3>& points, int handle,
                           const RegionOfTurning& region);

}  // namespace keyline::lac
