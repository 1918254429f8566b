#include <algorithm>
#include <stdexcept>

#include "keyline/core/angle.h"
#include "keyline/lac/segment/arm_table.h"
#include "keyline/lac/segment/segment.h"

namespace keyline::lac {
namespace {

using core::Point2;
using core::Vector2;

/// An arm's table with its place: point = origin + R(direction) (vector from the heavy end).
struct PlacedArm {
  detail::ArmTable table;
  Point2 heavy;
  Vector2 axis;  ///< length times unit tangent at the heavy end, into the arm
};

Vector2 turned(Vector2 axis, Vector2 v) {
  return {axis.x * v.x - axis.y * v.y, axis.y * v.x + axis.x * v.y};
}

/// Places an arm that starts at the pose; moves the pose to its end.
PlacedArm place_arm(const detail::Arm& arm, core::Pose2& pose) {
  detail::ArmTable table(arm);
  const double forward = arm.backward ? -arm.turning : arm.turning;
  if (!arm.backward) {
    const Vector2 axis = arm.length * core::unit_vector(pose.direction);
    const Point2 heavy = pose.position;
    pose = {heavy + turned(axis, table.end()), pose.direction + forward};
    return {std::move(table), heavy, axis};
  }
  pose.direction += forward;
  const Vector2 axis = -arm.length * core::unit_vector(pose.direction);
  pose.position = pose.position - turned(axis, table.end());
  return {std::move(table), pose.position, axis};
}

Point2 point_on(const PlacedArm& placed, double t) {
  const detail::Arm& arm = placed.table.arm();
  const double done = (t - arm.from) / (arm.to - arm.from);
  const double left = (arm.to - t) / (arm.to - arm.from);
  const Vector2 v =
      arm.backward ? placed.table.vector_at(left, done) : placed.table.vector_at(done, left);
  return placed.heavy + turned(placed.axis, v);
}

}  // namespace

void sample(const Segment& segment, std::span<const double> at, std::span<Point2> points) {
  if (at.size() != points.size()) throw core::InvalidInput("sample: sizes of the spans differ");
  const detail::Arms arms = detail::arms_of(piece_of(segment));
  core::Pose2 pose = segment.start;
  const PlacedArm first = place_arm(arms.arm[0], pose);
  const PlacedArm second = arms.count > 1 ? place_arm(arms.arm[1], pose) : first;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double t = std::clamp(at[i], 0.0, 1.0);
    points[i] = point_on(t <= arms.arm[0].to ? first : second, t);
  }
}

std::vector<Point2> sample(const Segment& segment, int n) {
  if (n < 2) throw core::InvalidInput("sample: fewer than two points asked for");
  std::vector<double> at(n);
  for (int i = 0; i < n; ++i) at[i] = i / (n - 1.0);
  std::vector<Point2> points(n);
  sample(segment, at, points);
  return points;
}

}  // namespace keyline::lac
