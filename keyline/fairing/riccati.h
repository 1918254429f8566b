#pragma once

#include <vector>

#include <Eigen/Core>

namespace keyline::fairing::detail {

using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix4 = Eigen::Matrix<double, 4, 4>;
using Vector4 = Eigen::Matrix<double, 4, 1>;
using Matrix47 = Eigen::Matrix<double, 4, 7>;

/// One piece of the chain in the quadratic model: state (x, y, direction, curvature) of the joint
/// before it, controls (length, slope, curvature of the joint after it).
struct Stage {
  Matrix7 hessian = Matrix7::Zero();
  Vector7 gradient = Vector7::Zero();
  Matrix47 step = Matrix47::Zero();  ///< next state's change by this stage's seven variables
  Vector4 gap = Vector4::Zero();     ///< next state's mismatch, to be closed
  bool fixed[3] = {false, false, false};
};

/// What is held at the two ends and, for a closed chain, how they are tied.
struct Boundary {
  bool closed = false;
  bool fixed_start[4] = {false, false, false, false};
  Matrix4 end_hessian = Matrix4::Zero();  ///< of the end state, or of (end - start) if closed
  Vector4 end_gradient = Vector4::Zero();
};

/// Changes of the states (one more than stages) and of the controls.
struct Step {
  std::vector<Vector4> state;
  std::vector<Eigen::Vector3d> control;
  bool sound = true;  ///< false: a pivot was not positive, the step is not usable
};

/// Minimises the sum of the stages' quadratic models under their linear dynamics.
/// Cost: linear in the number of stages.
Step solve_stages(const std::vector<Stage>& stages, const Boundary& boundary);

}  // namespace keyline::fairing::detail
