#pragma once

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/core/axis.h"

namespace keyline::core {

/// Second moments of points in the plane about their mean: how far they spread, and which way.
struct SecondMoments {
  double xx = 0, xy = 0, yy = 0;

  /// A point more, by what leads to it from the mean.
  void add(Vector2 d, double weight = 1) {
    xx += weight * d.x * d.x;
    xy += weight * d.x * d.y;
    yy += weight * d.y * d.y;
  }
  /// Unit vector along which the points spread most, of the two the one whose x is not negative.
  Vector2 direction() const { return unit_vector(principal_angle(xx, xy, yy)); }
  /// Moments along that direction and across it; neither is below 0.
  double along() const { return 0.5 * (xx + yy) + half_difference(); }
  double across() const { return std::max(0.5 * (xx + yy) - half_difference(), 0.0); }

 private:
  double half_difference() const { return 0.5 * std::hypot(xx - yy, 2 * xy); }
};

}  // namespace keyline::core
