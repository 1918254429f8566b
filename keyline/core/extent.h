#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>

#include "keyline/core/point.h"

namespace keyline::core {

/// Axis-parallel box around the points taken so far; of none its low corner lies beyond its high
/// one.
struct Box3 {
  Point3 low{INFINITY, INFINITY, INFINITY};
  Point3 high{-INFINITY, -INFINITY, -INFINITY};

  void take(Point3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void take(Point2 p) { take(Point3{p.x, p.y, 0}); }
};

/// Box of a range of points.
template <class Points>
Box3 box_of(const Points& points) {
  Box3 box;
  for (const auto& p : points) box.take(p);
  return box;
}

inline bool is_empty(const Box3& box) { return !(box.low.x <= box.high.x); }
/// Length of its diagonal; 0 of an empty box.
inline double diagonal(const Box3& box) { return is_empty(box) ? 0 : distance(box.low, box.high); }
/// Its longest side; 0 of an empty box.
inline double longest_side(const Box3& box) {
  const Vector3 sides = box.high - box.low;
  return is_empty(box) ? 0 : std::max({sides.x, sides.y, sides.z});
}

/// Largest distance of a point from the first; 0 for none.
template <class Points>
double reach(const Points& points) {
  double farthest = 0;
  for (const auto& p : points) farthest = std::max(farthest, distance(p, *std::begin(points)));
  return farthest;
}

}  // namespace keyline::core
