#pragma once

#include <map>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "keyline/surface/hold_joints.h"

/// Internals of room surface: what keeps the order of joints, as linear conditions.
namespace keyline::surface::detail {

/// A weighted sum of control points, by their number: those of all patches, net after net.
using Form = std::map<Eigen::Index, double>;

/// Sums that have to stay what they are in `given` for the joints to keep their order.
std::vector<Form> joint_conditions(std::span<const BezierSurface> given,
                                   std::span<const HeldJoint> joints);

/// The control points of all patches, a row each, and the patches with others.
Eigen::MatrixX3d coordinates(std::span<const BezierSurface> patches);
std::vector<BezierSurface> with_coordinates(std::span<const BezierSurface> patches,
                                            const Eigen::MatrixX3d& all);

}  // namespace keyline::surface::detail
