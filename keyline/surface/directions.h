#pragma once

#include "keyline/core/axis.h"
#include "keyline/core/point.h"

/// Directions in space. For .cpp files of this room only.
namespace keyline::surface::detail {

inline core::Vector3 unit(core::Vector3 v) { return v / norm(v); }

/// v without its part along the unit vector n.
inline core::Vector3 across(core::Vector3 v, core::Vector3 n) { return v - dot(v, n) * n; }

/// A unit vector at right angles to the unit vector n: along an axis that n is far from, as seen
/// along n.
inline core::Vector3 any_across(core::Vector3 n) { return cross(core::any_normal(n), n); }

}  // namespace keyline::surface::detail
