#pragma once

#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/core/pose.h"
#include "keyline/document/planar_curve.h"

/// Work on whole curves: parts, mirror images, offsets.
namespace keyline::document {

/// The part of the curve between two parameters, each type as itself. Precondition:
/// 0 <= low < high <= 1.
PlanarCurve part(const PlanarCurve& c, const core::Interval& t);
/// The same of a path: whole members stay as they are. Never closed.
Path part(const Path& path, const core::Interval& t);

/// The part of a closed path from one parameter over its seam to another: open, of one member where
/// the parts beside the seam go on as one chain or polyline. Precondition: 0 <= to < from <= 1, not
/// all of [0, 1] left out; the ends meet.
Path part_over_seam(const Path& path, double from, double to);

/// The mirror image in the line through the pose's position along its direction.
PlanarCurve mirrored(const PlanarCurve& c, const core::Pose2& axis);
Path mirrored(const Path& path, const core::Pose2& axis);

struct Offset {
  Path path;
  double deviation = 0;  ///< of its members from the exact offset, at most the tolerance
  int arcs = 0;          ///< put in where the given path has a corner that opens
};
/// The path at a constant distance to its left (right where negative): of a log-aesthetic piece of
/// constant curvature exactly, of all else cubics within the tolerance (> 0), an arc about every
/// corner that opens. Closed where the path is or its ends lie within `one_end`; where it closes, a
/// turn that parts the offset by no more than that is no corner. Members without length are left
/// out.
/// Fails: undrawable where all are, where the distance reaches a radius of curvature (the offset
/// would turn back), with that radius, and at a corner that closes.
core::Result<Offset> offset(const Path& path, double distance, double tolerance, double one_end);

}  // namespace keyline::document
