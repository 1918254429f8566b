#include "keyline/lac/hermite/compound_family.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/clamping.h"
#include "keyline/lac/segment/arm.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac::detail {

using core::Vector2;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Exponents up to here are taken as they are; beyond, e^x - 1 is e^x.
constexpr double kLargeExponent = 600;

/// ln of decay_integral(k, x).
double log_decay(double k, double x) {
  if (-k * x > kLargeExponent) return -k * x - std::log(-k);
  return std::log(decay_integral(k, x));
}

/// x with ln of decay_integral(k, x) = log_y; infinite from k y = 1 on.
double inverse_log_decay(double k, double log_y) {
  if (k < 0 && std::log(-k) + log_y > kLargeExponent) return (std::log(-k) + log_y) / -k;
  const double y = std::exp(log_y);
  const double z = k * y;
  if (z >= 1) return kInfinity;
  return std::abs(z) < 1e-300 ? y : -std::log1p(-z) / k;
}

Vector2 turned(Vector2 unit, Vector2 v) {
  return {unit.x * v.x - unit.y * v.y, unit.y * v.x + unit.x * v.y};
}

/// The chord of a side from its end of smaller radius, in the frame of the tangent there, and its
/// derivative by q; unit arc length.
ChordValue chord_of(const CompoundSide& side, double q) {
  const ChordValue v = chord_value(decays_of(side.alpha), side.theta, q);
  if (side.alpha < 0) return v;
  const Vector2 end = core::unit_vector(side.theta);
  return {turned(end, {v.chord.x, -v.chord.y}), turned(end, {v.slope.x, -v.slope.y})};
}

/// True where the sharp end of a side is the better known one when its range is large.
bool from_sharp(const CompoundSide& side) { return side.alpha < 0.5; }

/// A side as pieces, by the range x from its sharp or its flat end, the anchor, where arc length
/// and turning go as decay_integral(arc, x) and decay_integral(angle, x). The anchor comes first.
class SidePieces {
 public:
  /// log_anchor: ln of curvature there.
  SidePieces(const CompoundSide& side, double q, double log_length, double log_anchor)
      : side_(side),
        way_(from_sharp(side) ? -1 : 1),
        arc_decay_(way_ * side.alpha),
        angle_decay_(way_ * (side.alpha - 1)),
        q_(q),
        log_length_(log_length),
        log_anchor_(log_anchor) {}

  /// From the length, to rounding however large the range.
  static double log_anchor(const CompoundSide& side, double q, double log_length) {
    const double way = from_sharp(side) ? -1 : 1;
    const double balance =
        q == 0 ? 0 : log_decay(way * side.alpha, q) - log_decay(way * (side.alpha - 1), q);
    return std::log(side.theta) + balance - log_length;
  }

  bool far() const {
    const double end = log_anchor_ + way_ * q_;
    return std::abs(log_anchor_) > kFar || (std::isfinite(end) && std::abs(end) > kFar);
  }

  std::vector<Piece> run(bool clamped) const {
    if (!clamped) return {std::isinf(q_) ? endless() : between(0, q_)};
    const double a = range_at(-way_ * kKept);
    const double b = range_at(way_ * kKept);
    std::vector<Piece> pieces;
    if (a > 0) pieces.push_back(arc(0, a, -way_));
    if (b > a) pieces.push_back(between(a, b));
    if (q_ > b) pieces.push_back(arc(b, q_, way_));
    std::erase_if(pieces, [](const Piece& p) { return !(p.length > 0); });
    return pieces;
  }

 private:
  /// Where ln(curvature) is x, kept within the side.
  double range_at(double x) const { return std::clamp(way_ * (x - log_anchor_), 0.0, q_); }
  double curvature_at(double x) const { return std::exp(log_anchor_ + way_ * x); }
  double share(double k, double from, double to) const {
    const auto upto = [&](double x) {
      return x >= q_ ? 1.0 : x <= 0 ? 0.0 : std::exp(log_decay(k, x) - log_decay(k, q_));
    };
    return upto(to) - upto(from);
  }

  /// Ends in a cusp or an inflection.
  Piece endless() const {
    return {side_.alpha, std::exp(log_length_), curvature_at(0), curvature_at(q_)};
  }
  Piece between(double from, double to) const {
    const double k0 = curvature_at(from);
    const double k1 = curvature_at(to);
    const double mean = numeric::power_mean_integral(k0, k1, -side_.alpha, 1);
    return {side_.alpha, side_.theta * share(angle_decay_, from, to) / mean, k0, k1};
  }
  /// Sharper (sense 1) or flatter (-1) than the doubles: keeps the turning, or the length.
  Piece arc(double from, double to, double sense) const {
    const double k = std::exp(sense * kKept);
    const double length = sense > 0 ? share(angle_decay_, from, to) * side_.theta / k
                                    : share(arc_decay_, from, to) * std::exp(log_length_);
    return {side_.alpha, length, k, k};
  }

  const CompoundSide& side_;
  double way_;  ///< of ln(curvature) from the anchor
  double arc_decay_, angle_decay_;
  double q_, log_length_, log_anchor_;
};

/// In order of growing radius.
std::vector<Piece> sharp_first(const CompoundSide& side, std::vector<Piece> pieces) {
  if (from_sharp(side)) return pieces;
  std::reverse(pieces.begin(), pieces.end());
  for (Piece& piece : pieces) std::swap(piece.curvature_start, piece.curvature_end);
  return pieces;
}

}  // namespace

CompoundFamily::CompoundFamily(const CompoundRhythm& rhythm, double theta)
    : sharp_{rhythm.alpha0, theta * rhythm.turning_share, rhythm.alpha0 - 1, rhythm.alpha0},
      flat_{rhythm.alpha1, theta * (1 - rhythm.turning_share), 1 - rhythm.alpha1, -rhythm.alpha1},
      theta_(theta) {
  const double limit0 = sharp_.angle > 0 ? 1 / (sharp_.angle * sharp_.theta) : kInfinity;
  const double limit1 = flat_.angle > 0 ? 1 / (flat_.angle * flat_.theta) : kInfinity;
  sharp_leads_ = limit0 < limit1;
}

CompoundShape CompoundFamily::shape(double q) const {
  const CompoundSide& other = sharp_leads_ ? flat_ : sharp_;
  const double log_rate = log_decay(leading().angle, q) - std::log(leading().theta);
  const double q_other = inverse_log_decay(other.angle, log_rate + std::log(other.theta));
  return sharp_leads_ ? CompoundShape{log_rate, q, q_other} : CompoundShape{log_rate, q_other, q};
}

CompoundFamily::Chord CompoundFamily::chord(double q) const {
  const CompoundShape s = shape(q);
  const std::array<double, 2> log_arc{log_decay(sharp_.arc, s.q0), log_decay(flat_.arc, s.q1)};
  Chord sum;
  sum.log_unit = std::max(log_arc[0], log_arc[1]);
  const auto add = [&](const CompoundSide& side, double range, double log_length, Vector2 frame) {
    const ChordValue v = chord_of(side, range);
    const double arc = std::exp(log_length - sum.log_unit);
    // Both ranges run so that Lambda is common to the sides.
    const double way =
        std::isinf(range) || std::isinf(q)
            ? 0.0
            : side.theta / leading().theta * std::exp(side.angle * range - leading().angle * q);
    const double darc = std::isinf(range) ? 0.0 : std::exp(-side.arc * range - sum.log_unit);
    sum.chord = sum.chord + turned(frame, arc * v.chord);
    sum.slope = sum.slope + way * turned(frame, darc * v.chord + arc * v.slope);
    sum.arc += arc;
  };
  add(sharp_, s.q0, log_arc[0], {1, 0});
  add(flat_, s.q1, log_arc[1], core::unit_vector(sharp_.theta));
  return sum;
}

ChordSample CompoundFamily::sample(double q, Vector2 axis) const {
  ChordSample s;
  s.q = q;
  const Chord c = chord(q);
  const double square = dot(c.chord, c.chord);
  s.miss = core::angle_between(axis, c.chord);
  s.slope = cross(c.chord, c.slope) / square;
  if (std::abs(s.slope) < 1e-15) s.slope = 0;  // rounding: halve the bracket instead
  s.length = std::sqrt(square) / c.arc;
  return s;
}

/// Beyond it logarithms would lose the digits that matter.
double CompoundFamily::largest_range() const {
  constexpr double kRange = 1e15;
  constexpr double kLogRate = 1e6;
  const CompoundSide& other = sharp_leads_ ? flat_ : sharp_;
  const double log_rate =
      std::min(kLogRate, log_decay(other.angle, kRange) - std::log(other.theta));
  return std::min(kRange, inverse_log_decay(leading().angle, log_rate + std::log(leading().theta)));
}

SearchSetup CompoundFamily::setup(double psi) const {
  SearchSetup setup;
  const Decays d = decays_of(leading().alpha);
  const double excess = psi - theta_ / 2;
  setup.k = d.k;
  // Second derivatives grow where the other side's range runs faster: demand more before stopping.
  setup.sharpness = 100 * (1 + std::abs(sharp_.alpha) + std::abs(flat_.alpha));
  setup.guess = excess / circle_slope(theta_) * (leading().theta / theta_);
  setup.limit_drawn = limit_drawn();
  setup.inside = psi < limit_chord_angle();
  setup.largest = largest_range();
  return setup;
}

double CompoundFamily::limit_chord_angle() const {
  if (limit_drawn()) {
    const Vector2 c = chord(kInfinity).chord;
    const double angle = core::direction_of(c);
    return std::clamp(angle < 0 ? angle + 2 * core::kPi : angle, theta_ / 2, theta_);
  }
  if (flat_.alpha <= 1) return theta_;
  return std::min(sharp_.theta + detail::limit_chord_angle(flat_.alpha, flat_.theta), theta_);
}

CompoundPieces CompoundFamily::pieces(double q) const {
  const CompoundShape s = shape(q);
  const Chord c = chord(q);
  const double log_chord = std::log(norm(c.chord));
  const auto log_length = [&](const CompoundSide& side, double range) {
    return log_decay(side.arc, range) - c.log_unit - log_chord;
  };
  const double length0 = log_length(sharp_, s.q0);
  const double length1 = log_length(flat_, s.q1);
  // ln of curvature at the anchors and at the joint, the longer side's first.
  double anchor0 = SidePieces::log_anchor(sharp_, s.q0, length0);
  double anchor1 = SidePieces::log_anchor(flat_, s.q1, length1);
  const double joint0 = from_sharp(sharp_) ? anchor0 - s.q0 : anchor0;
  const double joint1 = from_sharp(flat_) ? anchor1 : anchor1 + s.q1;
  if (length0 > length1) {
    if (s.q1 < kKept) anchor1 = from_sharp(flat_) ? joint0 : joint0 - s.q1;
  } else if (s.q0 < kKept) {
    anchor0 = from_sharp(sharp_) ? joint1 + s.q0 : joint1;
  }
  const SidePieces sharp(sharp_, s.q0, length0, anchor0);
  const SidePieces flat(flat_, s.q1, length1, anchor1);
  const bool clamped = sharp.far() || flat.far();
  CompoundPieces p{sharp_first(sharp_, sharp.run(clamped)), sharp_first(flat_, flat.run(clamped)),
                   clamped};
  if (p.sharp.empty() || p.flat.empty()) return p;
  double& before = p.sharp.back().curvature_end;
  double& after = p.flat.front().curvature_start;
  (length0 > length1 ? after : before) = length0 > length1 ? before : after;
  return p;
}

}  // namespace keyline::lac::detail
