#pragma once

#include <array>
#include <span>
#include <vector>

#include "keyline/surface/bezier_surface.h"
#include "keyline/surface/continuity.h"

namespace keyline::surface {

/// Two patches of a list that lie edge to edge.
struct PatchJoint {
  std::size_t first = 0;
  std::size_t second = 0;
  std::array<Edge, 2> edges{};
};

/// Pairs of edges, in the order of the list, whose ends lie together and whose largest gap is at
/// most `gap`; edges shorter than that are none. An edge may lie along part of another: those are
/// not found.
std::vector<PatchJoint> joints_of(std::span<const BezierSurface> patches, double gap);

/// How the patches fit along their joints.
struct JointSummary {
  std::size_t joints = 0;
  std::array<std::size_t, 3> order_at_least{};  ///< joints that are at least G0, G1, G2
  double gap = 0;                               ///< largest of all
  double angle = 0;                             ///< largest fold, radians
  std::size_t widest = 0;                       ///< joint of the largest gap, the first of equals
  std::size_t sharpest = 0;                     ///< joint of the largest fold
};

/// Order of every joint, -1 to 3, measured at 33 places of it (edge_continuity).
std::vector<int> joint_orders(std::span<const PatchJoint> joints,
                              std::span<const BezierSurface> patches,
                              const EdgeTolerance& tolerance = {});

/// Joints whose order is lower in the patches `after` than in those `before`, of orders up to
/// `most`.
std::size_t lost_orders(std::span<const PatchJoint> joints, std::span<const BezierSurface> before,
                        std::span<const BezierSurface> after, int most,
                        const EdgeTolerance& tolerance = {});

/// The same places of every joint.
JointSummary measure_joints(std::span<const PatchJoint> joints,
                            std::span<const BezierSurface> patches,
                            const EdgeTolerance& tolerance = {});

}  // namespace keyline::surface
