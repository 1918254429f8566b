#pragma once

#include <span>

#include "keyline/core/point.h"

namespace keyline::acquire {

/// A plane in space with its own orthonormal axes; the default is the plane z = 0 with axes x, y.
struct Plane {
  core::Point3 origin;
  core::Vector3 axis_x{1, 0, 0};
  core::Vector3 axis_y{0, 1, 0};
  friend bool operator==(const Plane&, const Plane&) = default;
};

/// Coordinates in the plane of the foot of the perpendicular from p.
core::Point2 to_plane(const Plane& plane, core::Point3 p);

/// The point in space with plane coordinates p.
core::Point3 from_plane(const Plane& plane, core::Point2 p);

/// Signed distance of p from the plane, positive on the side of cross(axis_x, axis_y).
double distance_from_plane(const Plane& plane, core::Point3 p);

/// A plane and how far its points leave it.
struct PlaneFit {
  Plane plane;
  double departure = 0;      ///< largest distance of a point from the plane
  double departure_rms = 0;  ///< root mean square distance
};

/// The plane of least squared distance (principal components). Where a plane parallel to two
/// coordinate axes fits as well (departure at most 1.5 times as large) that one is taken, with the
/// coordinate axes as its own: z = c gives (x, y), y = c gives (x, z), x = c gives (y, z), and
/// plane coordinates then are the points' own coordinates. Any other plane has its vertical axis
/// along the projection of z.
/// Precondition: at least one point, all finite (throws InvalidInput).
PlaneFit fit_plane(std::span<const core::Point3> points);

}  // namespace keyline::acquire
