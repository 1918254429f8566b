#pragma once

#include <span>
#include <vector>

#include "keyline/surface/joints.h"

namespace keyline::surface {

/// A joint whose order stays.
struct HeldJoint {
  PatchJoint joint;
  int order = 1;       ///< 0, 1 or 2
  bool stiff = false;  ///< the control points that make the order stay where they are
};

/// The nets nearest to `wanted` (sum of squared distances of control points) that keep the order of
/// all joints, as one problem.
///
/// Across a joint of order 1 the derivatives D1 and D2 into both patches and E along the edge obey
/// D1 + beta D2 + gamma E = 0, of order 2 the second ones a like equation. Its multipliers are
/// those of `given` (polynomials of least squares, exact for patches cut from a spline); with them
/// held the equation is linear in the control points, and what it says of their moves is kept. A
/// joint of multipliers that are no such polynomials keeps its order for small moves only, and one
/// that is held to a higher order than it has keeps what it misses that by: a crease its fold, up
/// to the lengths of D1 and D2.
///
/// fixed: by patch and control point, those that do not move; or empty.
/// Precondition: patches as many, polynomial, of the same degrees on both sides.
std::vector<BezierSurface> hold_joints(std::span<const BezierSurface> given,
                                       std::span<const BezierSurface> wanted,
                                       std::span<const HeldJoint> joints,
                                       const std::vector<std::vector<bool>>& fixed = {});

/// Gives control points of common edges that coincide in `given`, to 1e-12 of the patches' extent,
/// one place again in `moved`, where rounding left them apart.
void close_joints(std::span<const BezierSurface> given, std::span<const HeldJoint> joints,
                  std::vector<BezierSurface>& moved);

}  // namespace keyline::surface
