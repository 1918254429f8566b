#pragma once

#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "keyline/surface/hold_joints.h"

/// Internals of room surface: what keeps the order of joints, as linear conditions.
namespace keyline::surface::detail {

/// A weighted sum of control points, by their number: those of all patches, net after net.
using Form = std::map<Eigen::Index, double>;

/// Numbers of the multipliers whose product a term has as a factor; -1: none.
using Factors = std::array<int, 2>;
inline constexpr Factors kNoFactor{-1, -1};
double value_of(const Factors& factors, const std::vector<double>& multipliers);

/// A weighted sum of control points whose weights depend on the multipliers of a joint.
struct JointForm {
  std::vector<std::pair<Factors, Form>> terms;

  Form at(const std::vector<double>& multipliers) const;
};

/// Sums that have to stay what they are in `given` for a joint to keep its order, whatever its
/// multipliers. Only where it `meets` them, so that they are 0 there, have others the same meaning.
struct JointEquations {
  std::vector<double> multipliers;  ///< of `given`
  bool meets = true;
  std::vector<JointForm> forms;
};

std::vector<JointEquations> joint_equations(std::span<const BezierSurface> given,
                                            std::span<const HeldJoint> joints);

/// All of them with the multipliers of `given`.
std::vector<Form> joint_conditions(std::span<const BezierSurface> given,
                                   std::span<const HeldJoint> joints);

/// The control points of all patches, a row each, and the patches with others.
Eigen::MatrixX3d coordinates(std::span<const BezierSurface> patches);
std::vector<BezierSurface> with_coordinates(std::span<const BezierSurface> patches,
                                            const Eigen::MatrixX3d& all);

}  // namespace keyline::surface::detail
