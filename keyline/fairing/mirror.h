#pragma once

#include <optional>
#include <vector>

#include "keyline/core/pose.h"

/// Mirror symmetry of measured points.
namespace keyline::fairing {

/// A line of symmetry, and how well points keep to it.
struct Mirror {
  core::Pose2 line;
  double rms = 0;  ///< of the distances of the mirrored points from the curve through the points
  double largest = 0;  ///< of them
};

/// The point's mirror image in the line.
core::Point2 mirrored(const core::Pose2& line, core::Point2 p);

/// Signed distance of the point left of the line.
double beside(const core::Pose2& line, core::Point2 p);

/// The line in which the points mirror best; of an open curve such that its ends change places.
/// Every pairing of evenly spaced places that a reflection can make is looked at, its best
/// line known in closed form (Procrustes); the best of them is then drawn to the curve through the
/// points by least squares of the normal distances.
///
/// The curve between points is a centripetal Catmull-Rom curve. Empty for fewer than six points.
std::optional<Mirror> best_mirror(const std::vector<core::Point2>& points, bool closed);

/// How well the points mirror in that very line.
Mirror measured_in(const core::Pose2& line, const std::vector<core::Point2>& points, bool closed);

}  // namespace keyline::fairing
