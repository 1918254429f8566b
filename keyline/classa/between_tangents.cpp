#include "keyline/classa/between_tangents.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::classa {
namespace {

constexpr double kMet = 1e-9;  ///< radians by which the chord may miss its direction

/// The scale of that alpha whose curve ends in the direction of the chord, on one side of s = 1.
std::optional<double> scale_between(double alpha, double chord, int degree,
                                    const core::Interval& s) {
  if (!(s.low < s.high)) return std::nullopt;
  const double found = scale_at_end_angle(alpha, chord, degree, s);
  if (std::abs(end_angle({alpha, found}, degree) - chord) > kMet) return std::nullopt;
  return found;
}

}  // namespace

std::optional<MatrixCurve> class_a_between(const EndTangents& ends, const BetweenRange& range) {
  const core::Vector2 chord = ends.end - ends.start;
  const double turn = core::angle_between(ends.start_tangent, ends.end_tangent);
  const double side = turn < 0 ? -1 : 1;
  const double ahead = side * core::angle_between(ends.start_tangent, chord);
  if (norm(chord) == 0 || !(ahead > 0 && ahead < std::abs(turn))) return std::nullopt;
  for (int degree = std::max(2, range.lowest_degree); degree <= range.highest_degree; ++degree) {
    const double alpha = std::abs(turn) / (degree - 1);
    if (alpha > range.alpha_max) continue;
    const double c = std::cos(alpha);
    auto s = scale_between(alpha, ahead, degree, {std::max(range.s.low, 1 / c), range.s.high});
    if (!s) s = scale_between(alpha, ahead, degree, {range.s.low, std::min(range.s.high, c)});
    if (!s) continue;
    const double length = norm(chord) / norm(end_in_frame({alpha, *s}, degree));
    return MatrixCurve{ends.start, length / norm(ends.start_tangent) * ends.start_tangent, 1,
                       ControlMatrix{side * alpha, *s}, degree};
  }
  return std::nullopt;
}

}  // namespace keyline::classa
