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
/// most `gap`, half the length of either and half the width of either patch across it, so that what
/// is found does not depend on the unit where patches are smaller than `gap`. Of edges within reach
/// of several others those that are nearest to one of the two are taken: thin sheets are not joined
/// across. An edge may lie along part of another, or be collapsed into a point: those are not
/// found.
std::vector<PatchJoint> joints_of(std::span<const BezierSurface> patches, double gap);

/// With the gap that holds between the patches of a list: kUsualGap of the size of all of them (the
/// diagonal of the box around their control points), unless it is set.
EdgeTolerance with_gap(const EdgeTolerance& tolerance, std::span<const BezierSurface> patches);

/// Pairs of edges that lie within ten times that gap of one another.
std::vector<PatchJoint> joints_of(std::span<const BezierSurface> patches,
                                  const EdgeTolerance& tolerance = {});

/// How a zebra breaks at joints, whatever the light, in radians. Stripes jump where there is a
/// fold: a mirrored ray by up to twice the fold. They turn where curvature jumps across a common
/// tangent plane: in the mean over all stripes of all lights that cross (stripe_turn.h).
struct ZebraBreaks {
  double jump = 0;       ///< largest, of joints without a gap
  double mean_jump = 0;  ///< over their length
  double turn = 0;       ///< of the joint at which stripes turn most, of those that are at least G1
  double mean_turn = 0;  ///< over all stripes that cross them
};

/// How the patches fit along their joints.
struct JointSummary {
  std::size_t joints = 0;
  std::array<std::size_t, 3> order_at_least{};  ///< joints that are at least G0, G1, G2
  double gap = 0;                               ///< largest of all
  double angle = 0;                             ///< largest fold of those without a gap, radians
  ZebraBreaks zebra;
  std::size_t widest = 0;    ///< joint of the largest gap, the first of equals
  std::size_t sharpest = 0;  ///< joint of the largest fold
};

/// What a joint amounts to: order, -1 to 3, largest fold, radians, and by how much stripes of a
/// zebra turn there in the mean (stripe_turn.h), 0 where none crosses or there is a fold.
struct JointState {
  int order = -1;
  double angle = 0;
  double turn = 0;
};

/// Of every joint, measured at 33 places of it (edge_continuity).
std::vector<JointState> joint_states(std::span<const PatchJoint> joints,
                                     std::span<const BezierSurface> patches,
                                     const EdgeTolerance& tolerance = {});

/// Joints whose order is lower in the patches `after` than in those `before`, of orders up to
/// `most`.
std::size_t lost_orders(std::span<const PatchJoint> joints, std::span<const BezierSurface> before,
                        std::span<const BezierSurface> after, int most,
                        const EdgeTolerance& tolerance = {});

/// The largest growth of a fold between patches that meet `before` and `after`, radians; 0 where
/// all are as flat as they were.
double fold_growth(std::span<const PatchJoint> joints, std::span<const BezierSurface> before,
                   std::span<const BezierSurface> after, const EdgeTolerance& tolerance = {});

/// Joints of one tangent plane before and after at which stripes turn farther after than before, by
/// more than what a jump of curvature that still counts as none may turn them
/// (tolerance.curvature, as an angle).
std::size_t turned_farther(std::span<const PatchJoint> joints,
                           std::span<const BezierSurface> before,
                           std::span<const BezierSurface> after,
                           const EdgeTolerance& tolerance = {});
bool turns_farther(const JointState& was, const JointState& is, const EdgeTolerance& tolerance);

/// The same places of every joint.
JointSummary measure_joints(std::span<const PatchJoint> joints,
                            std::span<const BezierSurface> patches,
                            const EdgeTolerance& tolerance = {});

}  // namespace keyline::surface
