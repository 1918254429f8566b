#pragma once

#include "keyline/core/point.h"
#include "keyline/core/similarity.h"

namespace keyline::core {

/// The points p with dot(normal, p) >= at_least.
struct HalfPlane {
  Vector2 normal{1, 0};  ///< of length 1, points inwards
  double at_least = 0;
};

/// How far the point lies inside; negative outside.
inline double depth(const HalfPlane& half, Point2 p) {
  return half.normal.x * p.x + half.normal.y * p.y - half.at_least;
}

/// The same half-plane where points have been moved by a similarity.
inline HalfPlane apply(const Similarity2& map, const HalfPlane& half) {
  const Point2 on =
      apply(map, Point2{half.at_least * half.normal.x, half.at_least * half.normal.y});
  const Vector2 normal = rotate_ccw(half.normal, map.rotation);
  return {normal, normal.x * on.x + normal.y * on.y};
}

}  // namespace keyline::core
