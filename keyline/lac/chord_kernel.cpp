#include "keyline/lac/chord_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/core/angle.h"
#include "keyline/lac/arm.h"
#include "keyline/numeric/quadrature.h"

namespace keyline::lac::detail {
namespace {

using core::Vector2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Sums over the nodes of a panel: integral of f and of (fraction of the turning) f, f = e^{-a
/// lambda} times tangent.
struct Moments {
  Vector2 zeroth;
  Vector2 first;
};

Moments panel_moments(const Arm& arm, const Panel& panel) {
  if (panel.straight) {
    const double fraction = panel.from == 0 ? 0.0 : arm.angle_fraction(panel.from);
    const double arc = decay_integral(arm.a, panel.to) - decay_integral(arm.a, panel.from);
    const Vector2 sum = arc * core::unit_vector(arm.turning * fraction);
    return {sum, fraction * sum};
  }
  constexpr const auto& rule = numeric::gauss_legendre<16>;
  const double width = panel.to - panel.from;
  Moments sum;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double lambda = panel.from + width * rule.nodes[i];
    const double fraction = arm.angle_fraction(lambda);
    const double weight = width * rule.weights[i] * std::exp(-arm.a * lambda);
    const Vector2 f = weight * core::unit_vector(arm.turning * fraction);
    sum.zeroth = sum.zeroth + f;
    sum.first = sum.first + fraction * f;
  }
  return sum;
}

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

/// The bracketed search; chord angles are measured from the heavy tangent.
class Search {
 public:
  Search(double alpha, double theta, double psi)
      : d_(decays_of(alpha)), theta_(theta), growing_(alpha < 0) {
    target_ = growing_ ? psi : theta - psi;
    axis_ = core::unit_vector(target_);
    excess_ = psi - theta / 2;
  }

  ChordSolution run();

 private:
  struct Sample {
    double q = 0;
    double miss = 0;  ///< psi reached less psi wanted, in the direction in which psi grows with q
    double slope = 0;
    double length = 1;
    double length_slope = 0;
  };
  Sample at(double q) const;
  double first_guess() const;
  double step(const Sample& s) const;
  ChordStatus verdict_at_limit(Sample& limit) const;
  double secant(const Sample& s, const Sample& beyond) const;

  Decays d_;
  double theta_ = 0;
  double target_ = 0;
  double excess_ = 0;
  Vector2 axis_;
  bool growing_ = false;
  double low_ = 0;
  double high_ = kInfinity;
};

Search::Sample Search::at(double q) const {
  const ChordValue v = chord_value(d_, theta_, q);
  const double sign = growing_ ? 1 : -1;
  Sample s;
  s.q = q;
  s.miss = sign * std::atan2(cross(axis_, v.chord), dot(axis_, v.chord));
  const double square = dot(v.chord, v.chord);
  s.slope = sign * cross(v.chord, v.slope) / square;
  s.length = std::sqrt(square);
  s.length_slope = dot(v.chord, v.slope) / s.length;
  return s;
}

/// psi - theta/2 is close to c tanh(q slope / c), exactly so for small angles at alpha = -1; c is
/// the limit for small angles.
double Search::first_guess() const {
  const double c = theta_ / (2 * (d_.a + std::abs(d_.b)));
  const double x = std::min(excess_ / c, 0.97);
  return c * std::atanh(x) / circle_slope(theta_);
}

/// Newton's step in e^{-kq}; infinite where it leads past the limit.
double Search::step(const Sample& s) const {
  const double x = d_.k * s.miss / s.slope;
  if (!(s.slope > 0) || !(x > -1)) return s.miss < 0 ? kInfinity : -kInfinity;
  return std::abs(x) < 1e-300 ? -s.miss / s.slope : -std::log1p(x) / d_.k;
}

/// What the limit q -> infinity says to a chord angle that finite q did not reach so far.
ChordStatus Search::verdict_at_limit(Sample& limit) const {
  const bool reachable = d_.a > 0 && d_.b > 0;
  const bool resolved = d_.k * kLargestRange > 40;
  limit = at(reachable && resolved ? kInfinity : kLargestRange);
  if (limit.miss > 0) return ChordStatus::solved;
  if (!reachable) {
    const bool inside = excess_ < theta_ / 2;
    return inside ? ChordStatus::beyond_precision : ChordStatus::beyond_region;
  }
  const Sample end = resolved ? limit : at(kInfinity);
  if (std::abs(end.miss) < 4e-16) {
    limit = end;
    return ChordStatus::solved;
  }
  return end.miss > 0 ? ChordStatus::beyond_precision : ChordStatus::beyond_region;
}

/// Secant between a sample short of the root and one beyond it, in e^{-kq} or, for small k, 1/q.
double Search::secant(const Sample& s, const Sample& beyond) const {
  const double share = -s.miss / (beyond.miss - s.miss);
  if (d_.k * kLargestRange > 40)
    return s.q - std::log1p(-share * (1 - decay(d_.k, beyond.q - s.q))) / d_.k;
  const double from = 1 / (1 + s.q);
  const double to = 1 / (1 + beyond.q);
  return 1 / (from + share * (to - from)) - 1;
}

ChordSolution Search::run() {
  if (!(excess_ > 0)) return {ChordStatus::solved, 0, at(0).length, 0};
  const double sharpness = std::max(d_.a, std::abs(d_.b));
  double q = std::min(first_guess(), kLargestRange);
  Sample s;
  int iteration = 1;
  for (; iteration <= 100; ++iteration) {
    s = at(q);
    const double change = step(s);
    if (s.miss == 0 || std::abs(s.miss * sharpness * change) < 2e-16) {
      const double next = std::max(0.0, q + (s.miss == 0 ? 0 : change));
      return {ChordStatus::solved, next, s.length + s.length_slope * (next - q), iteration};
    }
    (s.miss < 0 ? low_ : high_) = q;
    double next = q + change;
    if (next > kLargestRange && !std::isfinite(high_)) {
      Sample limit;
      const ChordStatus verdict = verdict_at_limit(limit);
      if (verdict != ChordStatus::solved) return {verdict, kInfinity, 1, iteration};
      if (limit.miss < 4e-16) return {verdict, limit.q, limit.length, iteration};
      next = secant(s, limit);
      if (next > kLargestRange) return {verdict, limit.q, limit.length, iteration};
      high_ = limit.q;
    }
    if (std::isfinite(high_) && high_ - low_ <= 4e-16 * high_) break;
    if (!(next > low_ && next < high_)) {
      next = (low_ + std::min(high_, kLargestRange)) / 2;
    }
    q = next;
  }
  return {ChordStatus::solved, q, s.length, iteration};
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
  const Arm arm = unit_arm(d, theta, q);
  PanelWalk walk(arm, q, 4, 3.2);
  Panel panel;
  Vector2 chord;
  Vector2 moment;
  while (walk.next(panel)) {
    const Moments m = panel_moments(arm, panel);
    chord = chord + m.zeroth;
    moment = moment + m.first;
  }
  chord = chord / arm.arc_total;
  moment = moment / arm.arc_total;
  if (q * std::max(d.a, std::abs(d.b)) < 1e-3) {
    const double slope = (d.b > d.a ? 1 : -1) * circle_slope(theta);
    return {chord, slope * core::perpendicular_left(chord)};
  }
  // d/dq of (1/S) integral of e^{-a l} e^{i theta T(l)/T(q)}, S and T the two totals.
  const double arc_end = decay(d.a, q) / arm.arc_total;
  const double angle_end = theta * decay(d.b, q) / arm.angle_total;
  const Vector2 slope =
      arc_end * (core::unit_vector(theta) - chord) - angle_end * core::perpendicular_left(moment);
  return {chord, slope};
}

ChordSolution solve_chord_angle(double alpha, double theta, double psi) {
  return Search(alpha, theta, psi).run();
}

double limit_chord_angle(double alpha, double theta) {
  if (alpha >= 0 && alpha <= 1) return theta;
  const Vector2 chord = chord_value(decays_of(alpha), theta, kInfinity).chord;
  const double angle = core::direction_of(chord);
  const double from_heavy = angle < 0 ? angle + 2 * core::kPi : angle;
  return alpha < 0 ? from_heavy : theta - from_heavy;
}

}  // namespace keyline::lac::detail
