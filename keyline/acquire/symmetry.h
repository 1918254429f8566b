#pragma once

#include <span>

#include "keyline/acquire/plane.h"
#include "keyline/core/error.h"
#include "keyline/core/point.h"

namespace keyline::acquire {

struct SymmetryPlane {
  Plane plane;
  double departure = 0;  ///< mean distance of a mirrored point from the nearest one, capped
};

/// The plane a cloud or the vertices of a mesh are symmetric in.
///
/// Method: coordinate planes and planes of the principal axes through the middle are tried; the
/// best is refined by pairing every mirrored point with its nearest neighbour (planes through the
/// midpoints, up to ten rounds). A coordinate direction, and position 0 in it, are taken where they
/// fit as well (2 %). Uses at most 4,000 points against at most 200,000.
/// Fails: bad_input for fewer than 20 points, points that are not finite or without extent;
///        undrawable, with the bounding box and the planes through its middle as a hint, where
///        mirrored points are further than half a spacing more than unrelated ones.
core::Result<SymmetryPlane> symmetry_plane(std::span<const core::Point3> points);

/// The plane of points p with dot(p, normal) = offset, |normal| = 1; its axes as in fit_plane().
Plane plane_of(core::Vector3 normal, double offset);

}  // namespace keyline::acquire
