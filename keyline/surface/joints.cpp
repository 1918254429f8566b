#include "keyline/surface/joints.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::surface {
namespace {

using core::Point3;

constexpr int kPlaces = 33;
constexpr int kCoarse = 8;          ///< steps along an edge, to find its neighbour
constexpr double kRounding = 1e-9;  ///< of the edge: gaps that are alike
constexpr std::array<Edge, 4> kEdges{Edge::u0, Edge::u1, Edge::v0, Edge::v1};

struct EdgeShape {
  Point3 start;
  Point3 end;
  double size = 0;  ///< the lesser of its length and its largest distance from the edge opposite
};

EdgeShape shape_of(const BezierSurface& s, Edge edge) {
  const Edge opposite = kEdges[static_cast<std::size_t>(edge) ^ 1U];
  const auto at = [&](Edge e, int i) {
    const auto [u, v] = edge_parameters(e, i / static_cast<double>(kCoarse));
    return evaluate(s, u, v);
  };
  double length = 0;
  double width = 0;
  for (int i = 0; i <= kCoarse; ++i) {
    width = std::max(width, distance(at(edge, i), at(opposite, i)));
    if (i > 0) length += distance(at(edge, i - 1), at(edge, i));
  }
  if (length <= kCollapsed * extent(s.net)) length = 0;
  return {at(edge, 0), at(edge, kCoarse), std::min(length, width)};
}

/// How far the edges may be apart and still be those of one joint: beyond half of an edge's length
/// its ends, beyond half of a patch's width its opposite edges could be taken for one another.
double reach(const EdgeShape& a, const EdgeShape& b, double gap) {
  return std::min({gap, 0.5 * a.size, 0.5 * b.size});
}

bool together(const EdgeShape& a, const EdgeShape& b, double gap) {
  if (!(gap > 0)) return false;
  const auto near = [gap](Point3 p, Point3 q) { return distance(p, q) <= gap; };
  return (near(a.start, b.start) && near(a.end, b.end)) ||
         (near(a.start, b.end) && near(a.end, b.start));
}

EdgeContinuity along(const PatchJoint& joint, std::span<const BezierSurface> patches,
                     const EdgeTolerance& tolerance, int count) {
  return *edge_continuity(patches[joint.first], patches[joint.second], joint.edges, tolerance,
                          count);
}

/// Two edges that lie together, numbered over all patches, four each.
struct Near {
  std::size_t a = 0;
  std::size_t b = 0;
  PatchJoint joint;
  double apart = 0;
};

/// A mirror that turns by an angle turns the ray by twice as much, by up to half a turn.
double ray_jump(double fold) { return std::min(2 * fold, core::kPi); }

/// Whether the normal turns along the joint; where it stands still no stripe crosses.
bool stripes_cross(const EdgeContinuity& c) { return c.turning > c.tolerance.angle; }

/// What the means of a zebra's breaks are made of.
struct ZebraSums {
  double length = 0, jumped = 0;
  double turning = 0, turned = 0;

  void add(const EdgeContinuity& c, ZebraBreaks& zebra) {
    const auto count = static_cast<double>(c.samples.size());
    for (const EdgeSample& s : c.samples) jumped += c.length / count * ray_jump(s.angle);
    length += c.length;
    zebra.jump = std::max(zebra.jump, ray_jump(c.angle));
    if (c.order < 1) return;
    turning += c.turning;
    turned += c.turning * c.stripe_turn;
    if (stripes_cross(c)) zebra.turn = std::max(zebra.turn, c.stripe_turn);
  }

  void finish(ZebraBreaks& zebra) const {
    if (length > 0) zebra.mean_jump = jumped / length;
    if (turning > 0) zebra.mean_turn = turned / turning;
  }
};

}  // namespace

std::vector<PatchJoint> joints_of(std::span<const BezierSurface> patches, double gap) {
  std::vector<EdgeShape> shapes;
  for (const BezierSurface& s : patches)
    for (const Edge e : kEdges) shapes.push_back(shape_of(s, e));
  std::vector<Near> pairs;
  std::vector<double> nearest(shapes.size(), HUGE_VAL);
  for (std::size_t a = 0; a < shapes.size(); ++a)
    for (std::size_t b = 4 * (a / 4 + 1); b < shapes.size(); ++b) {
      const double most = reach(shapes[a], shapes[b], gap);
      if (!together(shapes[a], shapes[b], most)) continue;
      const PatchJoint joint{a / 4, b / 4, {kEdges[a % 4], kEdges[b % 4]}};
      const double apart = along(joint, patches, {}, kCoarse + 1).gap;
      if (apart > most) continue;
      pairs.push_back({a, b, joint, apart});
      for (const std::size_t e : {a, b}) nearest[e] = std::min(nearest[e], apart);
    }
  std::ranges::sort(
      pairs, {}, [](const Near& p) { return std::array{p.joint.first, p.joint.second, p.a, p.b}; });
  std::vector<PatchJoint> joints;
  for (const Near& p : pairs) {
    const double rounding = kRounding * std::min(shapes[p.a].size, shapes[p.b].size);
    if (p.apart <= std::max(nearest[p.a], nearest[p.b]) + rounding) joints.push_back(p.joint);
  }
  return joints;
}

EdgeTolerance with_gap(const EdgeTolerance& tolerance, std::span<const BezierSurface> patches) {
  if (tolerance.gap) return tolerance;
  Net all;
  for (const BezierSurface& s : patches)
    all.points.insert(all.points.end(), s.net.points.begin(), s.net.points.end());
  return with_gap(tolerance, extent(all));
}

std::vector<PatchJoint> joints_of(std::span<const BezierSurface> patches,
                                  const EdgeTolerance& tolerance) {
  return joints_of(patches, 10 * *with_gap(tolerance, patches).gap);
}

std::vector<JointState> joint_states(std::span<const PatchJoint> joints,
                                     std::span<const BezierSurface> patches,
                                     const EdgeTolerance& tolerance) {
  std::vector<JointState> states;
  for (const PatchJoint& joint : joints) {
    const EdgeContinuity c = along(joint, patches, tolerance, kPlaces);
    const bool crossed = c.order >= 1 && stripes_cross(c);
    states.push_back({c.order, c.angle, crossed ? c.stripe_turn : 0});
  }
  return states;
}

std::size_t lost_orders(std::span<const PatchJoint> joints, std::span<const BezierSurface> before,
                        std::span<const BezierSurface> after, int most,
                        const EdgeTolerance& tolerance) {
  const auto was = joint_states(joints, before, tolerance);
  const auto is = joint_states(joints, after, tolerance);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < was.size(); ++i)
    lost += is[i].order < std::min(was[i].order, most) ? 1 : 0;
  return lost;
}

double fold_growth(std::span<const PatchJoint> joints, std::span<const BezierSurface> before,
                   std::span<const BezierSurface> after, const EdgeTolerance& tolerance) {
  const auto was = joint_states(joints, before, tolerance);
  const auto is = joint_states(joints, after, tolerance);
  double most = 0;
  for (std::size_t i = 0; i < was.size(); ++i)
    if (was[i].order >= 0 && is[i].order >= 0) most = std::max(most, is[i].angle - was[i].angle);
  return most;
}

bool turns_farther(const JointState& was, const JointState& is, const EdgeTolerance& tolerance) {
  // A relative jump x of curvature turns a stripe by x / 2 at most.
  return was.order >= 1 && is.order >= 1 && is.turn > was.turn + 0.5 * tolerance.curvature;
}

std::size_t turned_farther(std::span<const PatchJoint> joints,
                           std::span<const BezierSurface> before,
                           std::span<const BezierSurface> after, const EdgeTolerance& tolerance) {
  const auto was = joint_states(joints, before, tolerance);
  const auto is = joint_states(joints, after, tolerance);
  std::size_t count = 0;
  for (std::size_t i = 0; i < was.size(); ++i) count += turns_farther(was[i], is[i], tolerance);
  return count;
}

JointSummary measure_joints(std::span<const PatchJoint> joints,
                            std::span<const BezierSurface> patches,
                            const EdgeTolerance& tolerance) {
  JointSummary summary;
  summary.joints = joints.size();
  ZebraSums sums;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const EdgeContinuity c = along(joints[i], patches, tolerance, kPlaces);
    summary.order_at_least[0] += c.order >= 0;
    summary.order_at_least[1] += c.order >= 1;
    summary.order_at_least[2] += c.order >= 2;
    if (c.gap > summary.gap) summary.widest = i;
    summary.gap = std::max(summary.gap, c.gap);
    if (c.order < 0) continue;
    if (c.angle > summary.angle) summary.sharpest = i;
    summary.angle = std::max(summary.angle, c.angle);
    sums.add(c, summary.zebra);
  }
  sums.finish(summary.zebra);
  return summary;
}

}  // namespace keyline::surface
