#pragma once

#include "keyline/core/point.h"

namespace keyline::exchange::detail {

/// p -> origin + p.x * x + p.y * y + p.z * z.
struct Affine3 {
  core::Vector3 x{1, 0, 0};
  core::Vector3 y{0, 1, 0};
  core::Vector3 z{0, 0, 1};
  core::Point3 origin;
};

inline core::Vector3 apply(const Affine3& m, core::Vector3 v) {
  return v.x * m.x + v.y * m.y + v.z * m.z;
}
inline core::Point3 apply(const Affine3& m, core::Point3 p) {
  return m.origin + apply(m, p - core::Point3{});
}
/// First `inner`, then `outer`.
inline Affine3 combined(const Affine3& outer, const Affine3& inner) {
  return {apply(outer, inner.x), apply(outer, inner.y), apply(outer, inner.z),
          apply(outer, inner.origin)};
}

}  // namespace keyline::exchange::detail
