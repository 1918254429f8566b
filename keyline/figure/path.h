#pragma once

#include <array>
#include <span>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::figure {

enum class PathVerb { move, line, cubic, close };

/// One step of a path. move and line use point[2]; cubic uses all three (two handles, then the
/// end); close uses none.
struct PathStep {
  PathVerb verb = PathVerb::move;
  std::array<core::Point2, 3> point{};
  friend bool operator==(const PathStep&, const PathStep&) = default;
};

/// Open or closed runs of lines and cubics, in the order drawn.
struct Path {
  std::vector<PathStep> steps;

  Path& move_to(core::Point2 p);
  Path& line_to(core::Point2 p);
  Path& cubic_to(core::Point2 handle0, core::Point2 handle1, core::Point2 end);
  Path& close();
  friend bool operator==(const Path&, const Path&) = default;
};

/// Axis-parallel box; empty while min > max.
struct Box {
  core::Point2 min{1, 1};
  core::Point2 max{-1, -1};
  friend bool operator==(const Box&, const Box&) = default;
};

inline bool is_empty(const Box& b) { return !(b.min.x <= b.max.x && b.min.y <= b.max.y); }
inline double width(const Box& b) { return b.max.x - b.min.x; }
inline double height(const Box& b) { return b.max.y - b.min.y; }
/// Smallest box of b and p; points that are not finite change nothing.
void include(Box& b, core::Point2 p);
/// b grown by margin on every side.
Box grown(const Box& b, double margin);
/// Box of the finite points.
Box box_of(std::span<const core::Point2> points);

Path rectangle(const Box& box);
/// Four cubics, within 2.8e-4 of the radius.
Path circle(core::Point2 center, double radius);
/// Lines through the points; a point that is not finite breaks the line.
Path polyline(std::span<const core::Point2> points, bool closed = false);

/// The runs of the line through `points` that lie inside `box`, cut at its border. Points that are
/// not finite break the line.
std::vector<std::vector<core::Point2>> clip_to_box(std::span<const core::Point2> points,
                                                   const Box& box);

/// Subset of `points`, ends kept, within `tolerance` of the line through all of them
/// (Douglas and Peucker).
std::vector<core::Point2> simplify(std::span<const core::Point2> points, double tolerance);

/// The path without steps that are not finite; the line breaks there.
Path finite_part(const Path& path);

}  // namespace keyline::figure
