#pragma once

#include <optional>

#include "keyline/classa/control_matrix.h"

namespace keyline::classa {

/// Where a curve starts and ends, and in which directions (of any length but 0).
struct EndTangents {
  core::Point2 start;
  core::Vector2 start_tangent = {1, 0};
  core::Point2 end = {1, 0};
  core::Vector2 end_tangent = {1, 0};
};

/// Degrees and places of the alpha-s plane that a curve may take.
struct BetweenRange {
  int lowest_degree = 3;
  int highest_degree = 8;
  double alpha_max = 1.0982;       ///< radians; that of [Oya] Eq. 10
  core::Interval s = {0.01, 100};  ///< scales
};

/// The Class A curve with one matrix that keeps both ends and both tangents, of the lowest degree
/// in the range that has one. A degree has one at most: alpha is the turn over degree - 1, and the
/// direction of the chord grows with s on either side of the Class A region ([Oya] Eq. 5, 6).
/// Empty where the ends coincide, turn by half a turn or more or not at all, or turn to both sides;
/// or where the chord lies too near to the middle of the turn (a curve of constant curvature) or to
/// one of the tangents for any degree.
std::optional<MatrixCurve> class_a_between(const EndTangents& ends, const BetweenRange& range = {});

}  // namespace keyline::classa
