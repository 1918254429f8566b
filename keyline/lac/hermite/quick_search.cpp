#include "keyline/lac/hermite/quick_search.h"

#include <algorithm>
#include <cmath>

#include "keyline/lac/lanes/chord_lanes.h"
#include "keyline/lac/lanes/clothoid_lanes_body.h"

namespace keyline::lac::detail {
namespace {

using core::Vector2;

/// Largest decay plus turning that one panel carries to rounding.
constexpr double kLargestReach = 16;

/// (1 - e^{-k q}) / k and e^{-k q}.
struct Decay {
  double integral;
  double rest;
  Decay(double k, double q) {
    const double lost = std::expm1(-k * q);
    integral = k == 0 ? q : -lost / k;
    rest = 1 + lost;
  }
};

/// Chord and its derivative by q, as a fraction of the arc length, against the middle direction.
ChordValue centred_chord(const Decays& d, double theta, double q, double reach, int nodes,
                         Vector2 half, double circle) {
  const Decay arc(d.a, q);
  const Decay angle(d.b, q);
  const PanelSums s = panel_sums({d.a, d.b, 0, q, theta / angle.integral, theta / 2, nodes});
  const double unit = 1 / arc.integral;
  const Vector2 chord{s.x * unit, s.y * unit};
  if (reach - theta < 1e-3) return {chord, {-circle * chord.y, circle * chord.x}};
  const double angle_end = angle.rest / angle.integral * unit;
  const double arc_end = arc.rest * unit;
  return {chord,
          {arc_end * (half.x - chord.x) + angle_end * s.angle_y,
           arc_end * (half.y - chord.y) - angle_end * s.angle_x}};
}

/// atan r: exact to rounding where the search ends (small r), near enough where it starts.
double short_atan(double r) { return r / (1 + r * r / 3); }

}  // namespace

// With y = excess / c, c the limit of the excess, q slope / c is an odd function f(y) that begins
// as y + 1.2 (1 + s^2) c^2 y^3, s = 2 alpha - 1 and c for small angles and turning 1, and ends as
// -A ln(1 - y), A = (a + |b|) / (6 k): an inverse tanh and a cubic that have both, exact for small
// angles at alpha = -1 and 2.
RangeGuess guess_range(const Decays& d, double theta, double excess, double slope) {
  const double spread = d.a + std::abs(d.b);
  // With the turning the limit grows as the slope does, for most slopes (fitted to 3 %).
  const double share = d.b > d.a ? std::min(1.0, 2.5 * d.a) : d.b > 0 ? 0.8 * d.b / (1 + d.b) : 0;
  const double c = 0.5 * theta / spread * (1 + share * (12 * slope / theta - 1));
  const double y = std::min(excess / c, 0.98);
  const double s = d.a + d.b;  // |2 alpha - 1|
  const double end = std::min(2.0, spread / (6 * d.k));
  const double cubic = 0.3 * (1 + s * s) / (spread * spread) - 2 * end / 3;
  const double open = 1 / (1 - y * y);
  const double first = 2 * end * (open - 1) + 1 + 3 * cubic * y * y;
  const double second = y * (4 * end * open * open + 6 * cubic);
  const double scale = c / slope;
  return {scale * (y * (1 - 2 * end + y * y * cubic) + end * std::log((1 + y) / (1 - y))),
          second / (first * first * scale)};
}

bool quick_search(double alpha, double theta, double excess, ChordSolution& solution) {
  const Decays d = decays_of(alpha);
  const double sharpness = std::max(d.a, std::abs(d.b));
  const double h = theta / 2;
  const Vector2 half{std::cos(h), std::sin(h)};
  const double slope = h < 0.05 ? circle_slope(theta) : (1 - h * half.x / half.y) / theta;
  const double sign = alpha < 0 ? 1 : -1;  // of the chord angle's growth with q, as seen here
  const Vector2 axis{std::cos(excess), sign * std::sin(excess)};
  const RangeGuess guess = guess_range(d, theta, excess, slope);
  double q = guess.range;
  for (int iteration = 1; iteration <= 8; ++iteration) {
    solution.range = q;
    const double reach = sharpness * q + theta;
    if (!(q > 0 && reach < kLargestReach)) return false;
    const bool rough = iteration == 1;
    const int nodes = rough ? rough_nodes_for(reach) : nodes_for(reach);
    const ChordValue v = centred_chord(d, theta, q, reach, nodes, half, sign * slope);
    const double square = dot(v.chord, v.chord);
    const double miss = sign * short_atan(cross(axis, v.chord) / dot(axis, v.chord));
    const double rate = sign * cross(v.chord, v.slope) / square;
    const double newton = miss / rate;
    const double bend = guess.bend * newton;
    if (!(rate > 0 && bend > -0.8)) return false;
    const double change = -newton / (1 + 0.5 * bend);  // Newton's step to second order
    q += change;
    if (!rough && std::abs(miss * sharpness * change) < 1e-13) {
      const double length = std::sqrt(square);
      solution = {ChordStatus::solved, std::max(q, 0.0),
                  length + change * dot(v.chord, v.slope) / length, iteration};
      return true;
    }
  }
  return false;
}

std::optional<UnitCurve> quick_clothoid(double theta, double excess) {
  using One = numeric::simd::Scalar;
  const double h = theta / 2;
  const ClothoidLanes<One> c = clothoid_lanes(One(h), One(excess));
  if (!c.solved.on) return std::nullopt;
  const double y = c.y.value;
  return UnitCurve{c.chord_length.value, 2 * (h + y), 2 * (h - y), y / ((h + y) * (h + y))};
}

}  // namespace keyline::lac::detail
