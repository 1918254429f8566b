#include "keyline/surface/joints.h"

#include <algorithm>

namespace keyline::surface {
namespace {

using core::Point3;

constexpr int kPlaces = 33;
constexpr std::array<Edge, 4> kEdges{Edge::u0, Edge::u1, Edge::v0, Edge::v1};

struct EdgeEnds {
  Point3 start;
  Point3 end;
};

EdgeEnds ends_of(const BezierSurface& s, Edge edge) {
  const auto at = [&](double along) {
    const auto [u, v] = edge_parameters(edge, along);
    return evaluate(s, u, v);
  };
  return {at(0), at(1)};
}

bool together(const EdgeEnds& a, const EdgeEnds& b, double gap) {
  const auto near = [gap](Point3 p, Point3 q) { return distance(p, q) <= gap; };
  if (near(a.start, a.end) || near(b.start, b.end)) return false;
  return (near(a.start, b.start) && near(a.end, b.end)) ||
         (near(a.start, b.end) && near(a.end, b.start));
}

EdgeContinuity along(const PatchJoint& joint, std::span<const BezierSurface> patches,
                     const EdgeTolerance& tolerance, int count) {
  return *edge_continuity(patches[joint.first], patches[joint.second], joint.edges, tolerance,
                          count);
}

}  // namespace

std::vector<PatchJoint> joints_of(std::span<const BezierSurface> patches, double gap) {
  std::vector<std::array<EdgeEnds, 4>> ends;
  for (const BezierSurface& s : patches) {
    ends.emplace_back();
    for (std::size_t e = 0; e < 4; ++e) ends.back()[e] = ends_of(s, kEdges[e]);
  }
  std::vector<PatchJoint> joints;
  for (std::size_t i = 0; i < patches.size(); ++i)
    for (std::size_t k = i + 1; k < patches.size(); ++k)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b) {
          if (!together(ends[i][a], ends[k][b], gap)) continue;
          const PatchJoint joint{i, k, {kEdges[a], kEdges[b]}};
          if (along(joint, patches, {}, 9).gap <= gap) joints.push_back(joint);
        }
  return joints;
}

std::vector<int> joint_orders(std::span<const PatchJoint> joints,
                              std::span<const BezierSurface> patches,
                              const EdgeTolerance& tolerance) {
  std::vector<int> orders;
  for (const PatchJoint& joint : joints)
    orders.push_back(along(joint, patches, tolerance, kPlaces).order);
  return orders;
}

std::size_t lost_orders(std::span<const PatchJoint> joints, std::span<const BezierSurface> before,
                        std::span<const BezierSurface> after, int most,
                        const EdgeTolerance& tolerance) {
  const std::vector<int> was = joint_orders(joints, before, tolerance);
  const std::vector<int> is = joint_orders(joints, after, tolerance);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < was.size(); ++i) lost += is[i] < std::min(was[i], most) ? 1 : 0;
  return lost;
}

JointSummary measure_joints(std::span<const PatchJoint> joints,
                            std::span<const BezierSurface> patches,
                            const EdgeTolerance& tolerance) {
  JointSummary summary;
  summary.joints = joints.size();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const EdgeContinuity c = along(joints[i], patches, tolerance, kPlaces);
    summary.order_at_least[0] += c.order >= 0;
    summary.order_at_least[1] += c.order >= 1;
    summary.order_at_least[2] += c.order >= 2;
    if (c.gap > summary.gap) summary.widest = i;
    if (c.angle > summary.angle) summary.sharpest = i;
    summary.gap = std::max(summary.gap, c.gap);
    summary.angle = std::max(summary.angle, c.angle);
  }
  return summary;
}

}  // namespace keyline::surface
