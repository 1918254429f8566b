#include "keyline/curve/jet.h"

#include <cmath>
#include <limits>

namespace keyline::curve {
namespace {

using core::Vector2;
using core::Vector3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_zero(Vector2 v) { return v.x == 0 && v.y == 0; }

/// Sign of the turning just after a point of zero speed; 0 where the curve leaves straight.
double leaving_sign(const Jet2& jet) {
  const double turn = is_zero(jet.second) ? 0 : cross(jet.second, jet.third);
  return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}

}  // namespace

double tangent_angle(const Jet2& jet) {
  if (!is_zero(jet.first)) return core::direction_of(jet.first);
  if (!is_zero(jet.second)) return core::direction_of(jet.second);
  return is_zero(jet.third) ? 0 : core::direction_of(jet.third);
}

Vector2 unit_tangent(const Jet2& jet) {
  const double v = norm(jet.first);
  return v > 0 ? jet.first / v : core::unit_vector(tangent_angle(jet));
}

// Second and third derivative are divided by powers of the speed before they are multiplied, so
// that neither large nor small coordinates overflow.
double curvature(const Jet2& jet) {
  const double v = norm(jet.first);
  if (v > 0) return cross(jet.first / v, jet.second / v) / v;
  const double sign = leaving_sign(jet);
  return sign == 0 ? 0 : sign * kInfinity;
}

double curvature_rate(const Jet2& jet) {
  const double v = norm(jet.first);
  if (v > 0) {
    const Vector2 tangent = jet.first / v;
    const Vector2 second = jet.second / v;
    const double in_t =
        cross(tangent, jet.third / v) / v - 3 * (cross(tangent, second) / v) * dot(tangent, second);
    return in_t / v;
  }
  const double sign = leaving_sign(jet);
  return sign == 0 ? 0 : -sign * kInfinity;
}

core::Point2 centre_of_curvature(const Jet2& jet) {
  return jet.point + perpendicular_left(unit_tangent(jet)) * (1 / curvature(jet));
}

double curvature(const Jet3& jet) {
  const double v = norm(jet.first);
  if (v > 0) return norm(cross(jet.first / v, jet.second / v)) / v;
  return norm(cross(jet.second, jet.third)) > 0 ? kInfinity : 0;
}

double torsion(const Jet3& jet) {
  const double v = norm(jet.first);
  if (!(v > 0)) return 0;
  const Vector3 binormal = cross(jet.first / v, jet.second / v);
  const double size = norm(binormal);
  return size > 0 ? dot(binormal / size, jet.third / v) / v / size : 0;
}

}  // namespace keyline::curve
