#pragma once

#include <string>
#include <vector>

#include "keyline/surface/edit.h"
#include "keyline/surface/joint_rows.h"

/// Internals of room surface: nets of several patches with held joints, as many of whose curves as
/// can be have one matrix each.
namespace keyline::surface::detail {

struct TogetherTask {
  std::vector<BezierSurface> given;
  std::vector<HeldJoint> joints;
  std::vector<std::vector<bool>> fixed;  ///< by patch and control point: those that do not move
  std::vector<bool> open;                ///< by patch: its curves may be changed
  EditOptions options;
  JointMultipliers multipliers = JointMultipliers::given;
  bool most_or_none = false;  ///< no nets where fewer than half of the curves can be served
};

struct TogetherNets {
  std::string name;
  std::vector<BezierSurface> surfaces;
};

/// "one matrix", then "towards least energy" in steps: each the nearest to the given nets (least
/// squares of control points) that keeps every joint and the matrix of every curve that has one.
/// Which curves take one is found by the least sum of misfits, not of their squares, which leaves
/// most at none; those that cannot be served are given up one after the other. These stay planar,
/// and affine images of what they were, if without that they come to a worse type; "one matrix" is
/// given before and after that. Empty where no curve can be served; stops early on cancellation.
std::vector<TogetherNets> class_a_together(const TogetherTask& task);

}  // namespace keyline::surface::detail
