#pragma once

#include <array>

#include "keyline/surface/sample_grid.h"
#include "keyline/surface/surface.h"

namespace keyline::surface {

struct SurfacePoint {
  double u = 0;
  double v = 0;
  core::Point3 point;
  double distance = 0;
};

/// Step of Gauss-Newton in (u, v) towards the foot of a point, from the place of the jet, `off` it;
/// u or v stay where they are if they stand at a border and pull out.
std::array<double, 2> foot_step(const SurfaceJet& j, const core::Vector3& off, double u, double v);

/// Nearest points of one surface: the nearest of a grid of places, then Gauss-Newton within [0, 1].
/// Good to rounding where the given point is nearer than the surface's radii of curvature and the
/// grid tells the surface's folds apart.
class ClosestPoint {
 public:
  /// The surface must outlive this. 33 x 33 places for each Bézier patch, at most 513 x 513.
  explicit ClosestPoint(const Surface& s);
  SurfacePoint operator()(const core::Point3& p) const;

 private:
  const Surface& surface_;
  JetGrid grid_;
};

/// Largest distance of points of either surface (a grid of `places` x `places`) from the other.
double departure(const Surface& a, const Surface& b, int places = 33);

}  // namespace keyline::surface
