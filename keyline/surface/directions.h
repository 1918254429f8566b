#pragma once

#include <cmath>

#include "keyline/core/point.h"

/// Directions in space. For .cpp files of this room only.
namespace keyline::surface::detail {

inline core::Vector3 unit(core::Vector3 v) { return v / norm(v); }

/// v without its part along the unit vector n.
inline core::Vector3 across(core::Vector3 v, core::Vector3 n) { return v - dot(v, n) * n; }

/// Some unit vector at right angles to the unit vector n.
inline core::Vector3 any_across(core::Vector3 n) {
  const core::Vector3 axis = std::abs(n.x) < 0.6 ? core::Vector3{1, 0, 0} : core::Vector3{0, 1, 0};
  return unit(across(axis, n));
}

}  // namespace keyline::surface::detail
