#include "keyline/lac/segment/segment_table.h"

#include <algorithm>

#include "keyline/core/angle.h"

namespace keyline::lac {
namespace {

using core::Point2;
using core::Vector2;

Vector2 turned(Vector2 axis, Vector2 v) {
  return {axis.x * v.x - axis.y * v.y, axis.y * v.x + axis.x * v.y};
}

}  // namespace

SegmentTable::SegmentTable(const Segment& segment) {
  const detail::Arms arms = detail::arms_of(piece_of(segment));
  core::Pose2 pose = segment.start;
  first_ = place_arm(arms.arm[0], pose);
  if (arms.count > 1) second_ = place_arm(arms.arm[1], pose);
}

SegmentTable::PlacedArm SegmentTable::place_arm(const detail::Arm& arm, core::Pose2& pose) {
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

Point2 SegmentTable::PlacedArm::point(double t) const {
  const detail::Arm& arm = table.arm();
  const double done = (t - arm.from) / (arm.to - arm.from);
  const double left = (arm.to - t) / (arm.to - arm.from);
  return heavy +
         turned(axis, arm.backward ? table.vector_at(left, done) : table.vector_at(done, left));
}

Point2 SegmentTable::point(double t) const {
  t = std::clamp(t, 0.0, 1.0);
  return (t <= first_->table.arm().to ? first_ : second_)->point(t);
}

}  // namespace keyline::lac
