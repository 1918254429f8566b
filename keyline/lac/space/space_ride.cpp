#include "keyline/lac/space/space_ride.h"

namespace keyline::lac::detail {

using core::Vector3;

Motion Motion::moved(Vector3 turn, Vector3 shift) const {
  const double square = dot(turn, turn);
  const double angle = std::sqrt(square);
  const bool tiny = angle < 1e-3;
  const double s = tiny ? 1 - square / 6 : std::sin(angle) / angle;
  const double c = tiny ? 0.5 - square / 24 : (1 - std::cos(angle)) / square;
  const double v = tiny ? 1.0 / 6 - square / 120 : (1 - s) / square;
  const auto rotated = [&](Vector3 a) {
    const Vector3 once = cross(turn, a);
    return a + s * once + c * cross(turn, once);
  };
  const Vector3 once = cross(turn, shift);
  Motion next;
  next.at = at + turned(shift + c * once + v * cross(turn, once));
  next.tangent = turned(rotated({1, 0, 0}));
  next.normal = turned(rotated({0, 1, 0}));
  next.binormal = cross(next.tangent, next.normal);
  return next;
}

}  // namespace keyline::lac::detail
