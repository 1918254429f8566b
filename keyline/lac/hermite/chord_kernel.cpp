#include "keyline/lac/hermite/chord_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/chord_search.h"
#include "keyline/lac/hermite/quick_search.h"
#include "keyline/lac/segment/arm.h"
#include "keyline/numeric/power_mean.h"
#include "keyline/numeric/quadrature.h"

namespace keyline::lac::detail {
namespace {

using core::Vector2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Below it the slope of the chord is taken as a circle's, which is off by q; as a difference it is
/// off by eps / q.
constexpr double kNextToCircle = 1.5e-8;

Arm unit_arm(const Decays& d, double theta, double q) {
  Arm arm;
  arm.a = d.a;
  arm.b = d.b;
  arm.range = q;
  arm.length = 1;
  arm.turning = theta;
  arm.arc_total = decay_integral(d.a, q);
  arm.angle_total = decay_integral(d.b, q);
  return arm;
}

/// e^{-kx} with 0 * infinity read as a decay.
double decay(double k, double x) { return std::isinf(x) ? 0.0 : std::exp(-k * x); }

/// The chord against the wanted direction `axis`, angles measured from the heavy tangent; sign -1
/// where the chord angle seen from there falls with q.
ChordSample sample_at(const Decays& d, double theta, double q, Vector2 axis, double sign) {
  const ChordValue v = chord_value(d, theta, q);
  const double square = dot(v.chord, v.chord);
  ChordSample s;
  s.q = q;
  s.miss = sign * core::angle_between(axis, v.chord);
  s.slope = sign * cross(v.chord, v.slope) / square;
  s.length = std::sqrt(square);
  s.length_slope = dot(v.chord, v.slope) / s.length;
  return s;
}

/// From this |b| q on, b < 0, the turning lies within e^-600 of the light end.
constexpr double kTurnedLate = 600;

/// chord_value where all the turning lies next to the light end: the rest is straight. With x from
/// there the arc length goes as S = (e^{a q} - 1) / a, and the chord is 1 + G / S seen from the
/// light end, G = integral of e^{a x} (e^{-i theta e^{b x}} - 1) (see clamped.cpp). For a >= 0.4
/// the second term is below e^-240.
ChordValue late_chord(const Decays& d, double theta, double q) {
  if (d.a >= 0.4) return {{1, 0}, {0, 0}};
  Vector2 g;
  Vector2 power{1, 0};  // (-i theta)^k / k!
  for (int k = 1; k < 60; ++k) {
    power = (-theta / k) * core::perpendicular_left(power);
    g = g + power / (-k * d.b - d.a);
  }
  const double growth = numeric::expm1_over(d.a * q) * q;  // S; may be infinite
  const double share = 1 / growth;
  const double slope = -share * (d.a + share);  // d(1/S)/dq = -e^{aq} / S^2
  return {Vector2{1, 0} + share * Vector2{g.x, -g.y}, slope * Vector2{g.x, -g.y}};
}

}  // namespace

Decays decays_of(double alpha) {
  const double a = std::abs(alpha);
  const double b = alpha < 0 ? 1 - alpha : alpha - 1;
  return {a, b, std::min(a, std::abs(b))};
}

double circle_slope(double theta) {
  const double h = theta / 2;
  if (h < 0.05) return theta / 12 * (1 + h * h / 15 * (1 + 2 * h * h / 21));
  return (1 - h * std::cos(h) / std::sin(h)) / theta;
}

ChordValue chord_value(const Decays& d, double theta, double q) {
  if (q == 0) {
    const double h = theta / 2;
    const Vector2 middle = core::unit_vector(h);
    const double length = h == 0 ? 1 : std::sin(h) / h;
    const double slope = (d.b > d.a ? 1 : -1) * circle_slope(theta);
    return {length * middle, slope * length * core::perpendicular_left(middle)};
  }
  if (d.b < 0 && -d.b * q > kTurnedLate && std::isfinite(q)) return late_chord(d, theta, q);
  const Arm arm = unit_arm(d, theta, q);
  PanelWalk walk(arm, q, 6.5, 3.2);
  Panel panel;
  Vector2 chord;
  Vector2 moment;
  while (walk.next(panel)) {
    const PanelMoments m = panel_moments(arm, panel);
    chord = chord + m.zeroth;
    moment = moment + m.first;
  }
  chord = chord / arm.arc_total;
  moment = moment / arm.arc_total;
  if (q * std::max(d.a, std::abs(d.b)) < kNextToCircle) {
    const double slope = (d.b > d.a ? 1 : -1) * circle_slope(theta);
    return {chord, slope * core::perpendicular_left(chord)};
  }
  // d/dq of (1/S) integral of e^{-a l} e^{i theta T(l)/T(q)}, S and T the two totals.
  const double arc_end = decay(d.a, q) / arm.arc_total;
  const double angle_end = decay(d.b, q) / arm.angle_total;
  const Vector2 slope =
      arc_end * (core::unit_vector(theta) - chord) - angle_end * core::perpendicular_left(moment);
  return {chord, slope};
}

ChordSolution solve_chord_angle(double alpha, double theta, double psi) {
  const double excess = psi - theta / 2;
  if (!(excess > 0)) {
    const double h = theta / 2;
    return {ChordStatus::solved, 0, h == 0 ? 1 : std::sin(h) / h, 0};
  }
  ChordSolution quick;
  if (theta < core::kPi && quick_search(alpha, theta, excess, quick)) return quick;
  const Decays d = decays_of(alpha);
  const double sign = alpha < 0 ? 1 : -1;
  const Vector2 axis = core::unit_vector(alpha < 0 ? psi : theta - psi);
  SearchSetup setup;
  const bool started = quick.range > 0 && quick.range < kLargestRange;
  setup.guess = started ? quick.range : guess_range(d, theta, excess, circle_slope(theta)).range;
  setup.k = d.k;
  setup.sharpness = std::max(d.a, std::abs(d.b));
  setup.limit_drawn = d.a > 0 && d.b > 0;
  setup.inside = psi < theta;
  return search_chord(setup, [&](double q) { return sample_at(d, theta, q, axis, sign); });
}

double limit_chord_angle(double alpha, double theta) {
  if (alpha >= 0 && alpha <= 1) return theta;
  const Vector2 chord = chord_value(decays_of(alpha), theta, kInfinity).chord;
  const double angle = core::direction_of(chord);
  const double from_heavy = angle < 0 ? angle + 2 * core::kPi : angle;
  const double limit = alpha < 0 ? from_heavy : theta - from_heavy;
  // Rounding: of slopes near 1e16, nothing but the circle's; of slopes near 0 and 1, all.
  return std::clamp(limit, theta / 2, theta);
}

}  // namespace keyline::lac::detail
