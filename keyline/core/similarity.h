#pragma once

#include "keyline/core/angle.h"
#include "keyline/core/point.h"

namespace keyline::core {

/// Orientation-keeping similarity p -> scale * R(rotation) p + offset. scale > 0.
struct Similarity2 {
  double scale = 1;
  double rotation = 0;
  Vector2 offset;
  friend bool operator==(const Similarity2&, const Similarity2&) = default;
};

inline Point2 apply(const Similarity2& map, Point2 p) {
  const Vector2 v = map.scale * rotate_ccw({p.x, p.y}, map.rotation) + map.offset;
  return {v.x, v.y};
}

inline Vector2 apply(const Similarity2& map, Vector2 v) {
  return map.scale * rotate_ccw(v, map.rotation);
}

inline Similarity2 inverse(const Similarity2& map) {
  const Vector2 offset = (-1 / map.scale) * rotate_ccw(map.offset, -map.rotation);
  return {1 / map.scale, -map.rotation, offset};
}

}  // namespace keyline::core
