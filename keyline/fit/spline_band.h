#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "keyline/core/point.h"

namespace keyline::fit::detail {

/// Parameters from 0 to `end`, which is 0 again where the spline is closed.
struct ParameterRange {
  double end = 1;
  bool closed = false;

  double nearest(double t) const {
    if (closed) t -= end * std::floor(t / end);
    return std::clamp(t, 0.0, end);
  }
};

/// Whether p is farther than that from a spline near its parameter t, where the spline is at `on`:
/// a few of Newton's steps lead towards its foot.
template <class PointAt, class FirstAt>
bool farther_than(double tolerance, core::Point2 p, double t, core::Point2 on, ParameterRange range,
                  PointAt point_at, FirstAt first_at) {
  constexpr int kSteps = 4;
  for (int step = 0; step < kSteps; ++step) {
    if (core::distance(on, p) <= tolerance) return false;
    const core::Vector2 d = first_at(t);
    t = range.nearest(t + dot(p - on, d) / dot(d, d));
    on = point_at(t);
  }
  return !(core::distance(on, p) <= tolerance);
}

/// Asks whether a spline keeps a tolerance at all points, first at the one that did not last: the
/// likeliest to be outside again.
class Band {
 public:
  /// is_farther: whether a point, by its number, is outside.
  template <class IsFarther>
  bool holds(std::size_t points, IsFarther is_farther) {
    if (is_farther(outside_)) return false;
    for (std::size_t i = 0; i < points; ++i)
      if (is_farther(i)) {
        outside_ = i;
        return false;
      }
    return true;
  }

 private:
  std::size_t outside_ = 0;
};

}  // namespace keyline::fit::detail
