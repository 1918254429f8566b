#pragma once

#include <span>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::acquire::detail {

/// Feet of a section's points, moved along the surface instead of straight onto the plane.
///
/// A point at a distance d from the plane, on a surface that slopes across it, has its foot
/// beside the section by slope times d. The slope is fitted together with a parabola to the feet
/// near each point, and used where it explains the neighbours far better than the parabola alone.
/// `away`: signed distances of the points from the plane. Feet where nothing is to be explained
/// stay as they are, to the last bit.
std::vector<core::Point2> slide_to_section(std::span<const core::Point2> feet,
                                           std::span<const double> away);

}  // namespace keyline::acquire::detail
