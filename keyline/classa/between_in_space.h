#pragma once

#include <optional>

#include "keyline/classa/between_tangents.h"
#include "keyline/curve/bezier.h"

namespace keyline::classa {

/// Where a curve in space starts and ends, and in which directions (of any length but 0).
struct SpaceEndTangents {
  core::Point3 start;
  core::Vector3 start_tangent = {1, 0, 0};
  core::Point3 end = {1, 0, 0};
  core::Vector3 end_tangent = {1, 0, 0};
};

/// The Class A curve in space with one matrix, a rotation about an axis times a scale ([Farin
/// 2006]), that keeps both ends and both tangents, of the lowest degree in the range that has one:
/// curvature is certified to run one way. Where ends and tangents lie in one plane (to 1e-12) that
/// of the plane.
///
/// Both tangents make one angle with the axis, so it is perpendicular to their difference; one
/// angle of it and the scale are left for the two of the chord's direction. Of several solutions
/// the one whose axis is nearest to the tangents' common normal, about which they turn least.
///
/// Empty as class_a_between in the plane, and where no such curve was found.
std::optional<curve::Bezier3> class_a_between(const SpaceEndTangents& ends,
                                              const BetweenRange& range = {});

}  // namespace keyline::classa
