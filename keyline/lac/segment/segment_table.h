#pragma once

#include <optional>

#include "keyline/lac/segment/arm_table.h"
#include "keyline/lac/segment/segment.h"

namespace keyline::lac {

/// A segment integrated once, to be evaluated at many places: each takes the same time, however
/// often the segment turns.
class SegmentTable {
 public:
  /// Precondition: the segment is valid.
  explicit SegmentTable(const Segment& segment);
  /// As evaluate(segment, t), to 2e-15 of the length.
  core::Point2 point(double t) const;

 private:
  /// An arm's table with its place: point = heavy + R(axis) (vector from the heavy end).
  struct PlacedArm {
    detail::ArmTable table;
    core::Point2 heavy;
    core::Vector2 axis;  ///< length times unit tangent at the heavy end, into the arm
    core::Point2 point(double t) const;
  };
  /// Places an arm that starts at the pose; moves the pose to its end.
  static PlacedArm place_arm(const detail::Arm& arm, core::Pose2& pose);

  std::optional<PlacedArm> first_;
  std::optional<PlacedArm> second_;  ///< after an inflection
};

}  // namespace keyline::lac
