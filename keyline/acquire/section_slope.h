#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "keyline/acquire/plane.h"
#include "keyline/core/point.h"

namespace keyline::acquire::detail {

/// How a point of a cloud comes into the plane of a section.
struct Foot {
  enum class Way : std::uint8_t {
    straight,  ///< no surface is told, or the point strays from it more than the way matters
    along,     ///< along the surface, to `place`
    off        ///< not at all: its surface is off the plane as far as its neighbours reach
  };
  Way way = Way::straight;
  core::Point3 place{};
};

/// Feet of a cloud's points near the plane, along the surface that they lie on.
///
/// A point beside the plane has its straight foot beside the section where the surface slopes
/// across it, the farther the steeper. To the points near each a quadratic is fitted over their
/// plane of least squares, to as many as tell best where it meets the plane; straight up its slope
/// the point goes there, with what it strays from the surface. `band`: the largest distance of the
/// points from the plane; a surface that does not come to the plane so near to a point is off it.
std::vector<Foot> feet_on_plane(std::span<const core::Point3> cloud, const Plane& plane,
                                double band);

}  // namespace keyline::acquire::detail
