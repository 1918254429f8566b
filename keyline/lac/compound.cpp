#include "keyline/lac/compound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/arm.h"
#include "keyline/lac/chord_search.h"
#include "keyline/lac/slope.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Vector2;
using detail::decay_integral;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// x with decay_integral(k, x) = y; infinite from k y = 1 on.
double inverse_decay_integral(double k, double y) {
  const double z = k * y;
  if (z >= 1) return kInfinity;
  return std::abs(z) < 1e-300 ? y : -std::log1p(-z) / k;
}

/// One piece seen from the joint, radius of curvature 1 there: turning by theta takes the range q
/// with Lambda theta = decay_integral(angle, q), and Lambda times its arc length is
/// decay_integral(arc, q), Lambda being drho/ds at the joint ([Compound] Eqs. 2.2 and 2.3).
struct Side {
  double alpha = 0;
  double theta = 0;
  double angle = 0;
  double arc = 0;
};

Vector2 turned(Vector2 unit, Vector2 v) {
  return {unit.x * v.x - unit.y * v.y, unit.y * v.x + unit.x * v.y};
}

/// The chord of a side from its end of smaller radius, in the frame of the tangent there, and its
/// derivative by q; unit arc length.
detail::ChordValue chord_of(const Side& side, double q) {
  const detail::Decays d = detail::decays_of(side.alpha);
  const detail::ChordValue v = detail::chord_value(d, side.theta, q);
  if (side.alpha < 0) return v;
  const Vector2 end = core::unit_vector(side.theta);
  return {turned(end, {v.chord.x, -v.chord.y}), turned(end, {v.slope.x, -v.slope.y})};
}

/// All that follows from the joint's Lambda.
struct Shape {
  double rate = 0;  ///< Lambda at the joint
  double q0 = 0;
  double q1 = 0;
};

/// The family of compound curves of one rhythm and turning, by the range q of the side that runs
/// out first.
class Family {
 public:
  Family(const CompoundRhythm& rhythm, double theta)
      : sharp_{rhythm.alpha0, theta * rhythm.turning_share, rhythm.alpha0 - 1, rhythm.alpha0},
        flat_{rhythm.alpha1, theta * (1 - rhythm.turning_share), 1 - rhythm.alpha1, -rhythm.alpha1},
        theta_(theta) {
    const double limit0 = sharp_.angle > 0 ? 1 / (sharp_.angle * sharp_.theta) : kInfinity;
    const double limit1 = flat_.angle > 0 ? 1 / (flat_.angle * flat_.theta) : kInfinity;
    sharp_leads_ = limit0 < limit1;
  }

  const Side& sharp() const { return sharp_; }
  const Side& flat() const { return flat_; }
  const Side& leading() const { return sharp_leads_ ? sharp_ : flat_; }

  Shape shape(double q) const {
    const Side& other = sharp_leads_ ? flat_ : sharp_;
    const double rate = decay_integral(leading().angle, q) / leading().theta;
    const double q_other = inverse_decay_integral(other.angle, rate * other.theta);
    return sharp_leads_ ? Shape{rate, q, q_other} : Shape{rate, q_other, q};
  }

  /// True where the leading side can run out: it ends in a cusp (sharp) or an inflection (flat).
  bool limit_drawn() const { return sharp_leads_ || flat_.alpha < 0; }

  /// Chord times Lambda from the sharp end, its derivative by q, and arc length times Lambda.
  struct Chord {
    Vector2 chord;
    Vector2 slope;
    double arc = 0;
    double arc_slope = 0;
  };
  Chord chord(double q) const;

  detail::ChordSample sample(double q, Vector2 axis) const;
  detail::SearchSetup setup(double psi) const;
  double limit_chord_angle() const;

 private:
  Side sharp_;
  Side flat_;
  double theta_ = 0;
  bool sharp_leads_ = false;
};

Family::Chord Family::chord(double q) const {
  const Shape s = shape(q);
  const double rate_slope = std::isinf(q) ? 0 : std::exp(-leading().angle * q) / leading().theta;
  const auto range_slope = [&](const Side& side, double range) {
    return std::isinf(range) ? 0.0 : rate_slope * side.theta * std::exp(side.angle * range);
  };
  Chord sum;
  const auto add = [&](const Side& side, double range, Vector2 frame) {
    const detail::ChordValue v = chord_of(side, range);
    const double arc = decay_integral(side.arc, range);
    const double dq = range_slope(side, range);
    const double darc = std::isinf(range) ? 0.0 : std::exp(-side.arc * range);
    sum.chord = sum.chord + turned(frame, arc * v.chord);
    sum.slope = sum.slope + dq * turned(frame, darc * v.chord + arc * v.slope);
    sum.arc += arc;
    sum.arc_slope += dq * darc;
  };
  add(sharp_, s.q0, {1, 0});
  add(flat_, s.q1, core::unit_vector(sharp_.theta));
  return sum;
}

detail::ChordSample Family::sample(double q, Vector2 axis) const {
  detail::ChordSample s;
  s.q = q;
  const Chord c = chord(q);
  const double square = dot(c.chord, c.chord);
  s.miss = std::atan2(cross(axis, c.chord), dot(axis, c.chord));
  s.slope = cross(c.chord, c.slope) / square;
  s.length = std::sqrt(square) / c.arc;
  return s;
}

detail::SearchSetup Family::setup(double psi) const {
  detail::SearchSetup setup;
  const detail::Decays d = detail::decays_of(leading().alpha);
  const double excess = psi - theta_ / 2;
  setup.k = d.k;
  // Second derivatives grow where the other side's range runs faster: demand more before stopping.
  setup.sharpness = 100 * (1 + std::abs(sharp_.alpha) + std::abs(flat_.alpha));
  setup.guess = excess / detail::circle_slope(theta_) * (leading().theta / theta_);
  setup.limit_drawn = limit_drawn();
  setup.inside = psi < limit_chord_angle();
  // Neither range may leave the doubles, nor an arc length overflow.
  const Side& other = sharp_leads_ ? flat_ : sharp_;
  const auto cap = [](const Side& side) {
    return std::min(detail::kLargestRange, 600 / std::max(1e-9, -side.arc));
  };
  const double rate = decay_integral(other.angle, cap(other)) / other.theta;
  setup.largest =
      std::min(cap(leading()), inverse_decay_integral(leading().angle, rate * leading().theta));
  return setup;
}

double Family::limit_chord_angle() const {
  if (limit_drawn()) {
    const Vector2 c = chord(kInfinity).chord;
    const double angle = core::direction_of(c);
    return angle < 0 ? angle + 2 * core::kPi : angle;
  }
  if (flat_.alpha <= 1) return theta_;
  return sharp_.theta + detail::limit_chord_angle(flat_.alpha, flat_.theta);
}

bool is_valid(const CompoundRhythm& r) {
  return is_slope(r.alpha0) && is_slope(r.alpha1) && r.turning_share > 0 && r.turning_share < 1;
}

std::string number(double x) { return core::number_text(x, 9); }

/// The rhythm on the way from the given one to a full region (sharp slope at most 1, flat one in
/// [0, 1]) that first holds the chord angle psi >= theta/2.
CompoundRhythm nearest_rhythm(const CompoundRhythm& r, double theta, double psi) {
  const auto moved = [&](double way) {
    return CompoundRhythm{r.alpha0 + way * (std::min(r.alpha0, 1.0) - r.alpha0),
                          r.alpha1 + way * (std::clamp(r.alpha1, 0.0, 1.0) - r.alpha1),
                          r.turning_share};
  };
  const auto excess = [&](double way) {
    return Family(moved(way), theta).limit_chord_angle() - psi;
  };
  const auto root = numeric::bracketed_root(excess, 0, 0.97, 1e-9);
  return moved(root ? *root + 1e-6 * (1 - *root) : 1);
}

std::unexpected<core::Failure> undrawable(const CompoundRhythm& r, double theta, double psi) {
  const core::Interval region = drawable_region(r, theta);
  const double margin = 1e-6 * (region.high - region.low);
  const double nearest = std::clamp(psi, region.low + margin, region.high - margin);
  const CompoundRhythm other = nearest_rhythm(r, theta, std::max(psi, theta - psi));
  return core::fail(ErrorCode::undrawable,
                    "no compound curve of slopes " + number(r.alpha0) + ", " + number(r.alpha1) +
                        " turning by " + number(theta) + " rad has its chord at " + number(psi) +
                        " rad from the start tangent; it must lie between " + number(region.low) +
                        " and " + number(region.high),
                    "nearest chord angle " + number(nearest) + " rad, or slopes " +
                        number(other.alpha0) + ", " + number(other.alpha1));
}

core::Result<void> check(const HandleAngles& angles, const CompoundRhythm& rhythm) {
  if (!is_slope(rhythm.alpha0) || !is_slope(rhythm.alpha1)) {
    return core::fail(ErrorCode::bad_input, "both slopes must lie between -1e100 and 1e100");
  }
  if (!is_valid(rhythm)) {
    return core::fail(ErrorCode::bad_input, "the share of the turning must lie between 0 and 1");
  }
  if (std::isnan(angles.turning) || std::isnan(angles.chord_angle)) {
    return core::fail(ErrorCode::bad_input, "an angle is not a number");
  }
  const double theta = std::abs(angles.turning);
  const double psi = angles.turning < 0 ? -angles.chord_angle : angles.chord_angle;
  const bool straight = theta == 0 && psi == 0;
  if (!straight && !(theta < core::kPi - 1e-15 && psi > 0 && psi < theta)) {
    return core::fail(ErrorCode::undrawable,
                      "the middle point does not lie between the ends: the curve would turn back",
                      "put it nearer to the chord's middle");
  }
  return {};
}

/// The chain for a chord of length 1 along x, turning left, radius growing.
void set_curve(CompoundSolution& solution, const Family& family, double q) {
  const Shape s = family.shape(q);
  const double chord = norm(family.chord(q).chord);  // times Lambda, for radius 1 at the joint
  const double k = q == 0 ? 0 : chord / s.rate;
  const Side& sharp = family.sharp();
  const Side& flat = family.flat();
  solution.chain.pieces = {
      {sharp.alpha, decay_integral(sharp.arc, s.q0) / chord, k * std::exp(s.q0), k},
      {flat.alpha, decay_integral(flat.arc, s.q1) / chord, k, k * std::exp(-s.q1)}};
  const double at_start = std::isinf(s.q0) || sharp.alpha > 1 ? 0 : s.q0;
  solution.lambda0 = s.rate * std::exp(sharp.angle * at_start);
  solution.lambda1 = s.rate * std::exp(-flat.angle * at_start);
}

/// Two arcs of one circle (chord angle half the turning) or a straight line.
void set_circle(CompoundSolution& solution, const CompoundRhythm& r, double theta) {
  const double h = theta / 2;
  const double length = h == 0 ? 1 : h / std::sin(h);
  const double k = theta / length;
  solution.chain.pieces = {{r.alpha0, length * r.turning_share, k, k},
                           {r.alpha1, length * (1 - r.turning_share), k, k}};
}

}  // namespace

core::Interval drawable_region(const CompoundRhythm& rhythm, double theta) {
  if (!is_valid(rhythm) || !(theta > 0 && theta < core::kPi)) {
    throw core::InvalidInput("drawable_region: a bad rhythm, or theta outside (0, pi)");
  }
  const double limit = Family(rhythm, theta).limit_chord_angle();
  return {theta - limit, limit};
}

core::Result<CompoundSolution> solve_compound(const HandleAngles& angles,
                                              const CompoundRhythm& rhythm) {
  if (const auto checked = check(angles, rhythm); !checked) return std::unexpected(checked.error());
  const double sign = angles.turning < 0 ? -1 : 1;
  const double theta = sign * angles.turning;
  const double psi = sign * angles.chord_angle;
  CompoundSolution solution;
  solution.turning = angles.turning;
  solution.chord_angle = angles.chord_angle;
  solution.reversed = psi < theta / 2;
  const double wanted = solution.reversed ? theta - psi : psi;
  if (wanted == theta / 2) {
    set_circle(solution, rhythm, theta);
  } else {
    const Family family(rhythm, theta);
    const Vector2 axis = core::unit_vector(wanted);
    const detail::ChordSolution found = detail::search_chord(
        family.setup(wanted), [&](double q) { return family.sample(q, axis); });
    if (found.status == detail::ChordStatus::beyond_region) return undrawable(rhythm, theta, psi);
    if (found.status == detail::ChordStatus::beyond_precision) {
      return core::fail(ErrorCode::undrawable,
                        "the curvatures would differ by more than double precision holds",
                        "move the slopes away from 0 and 1");
    }
    set_curve(solution, family, found.range);
    solution.iterations = found.iterations;
  }
  Chain& chain = solution.chain;
  if (solution.reversed) {
    for (Piece& piece : chain.pieces) piece = mirrored(reversed(piece));
    std::swap(chain.pieces[0], chain.pieces[1]);
  }
  if (sign < 0) {
    for (Piece& piece : chain.pieces) piece = mirrored(piece);
  }
  chain.start = {{0, 0}, -angles.chord_angle};
  solution.joint = end_pose(segment_at(chain, 0)).position;
  return solution;
}

core::Result<CompoundSolution> solve_compound(core::Point2 p0, core::Point2 p1, core::Point2 p2,
                                              const CompoundRhythm& rhythm) {
  const auto angles = handle_angles(p0, p1, p2);
  if (!angles) return std::unexpected(angles.error());
  auto solution = solve_compound(*angles, rhythm);
  if (!solution) return solution;
  Chain& chain = solution->chain;
  for (Piece& piece : chain.pieces) {
    piece.length *= angles->chord;
    piece.curvature_start /= angles->chord;
    piece.curvature_end /= angles->chord;
  }
  chain.start = {p0, angles->direction};
  solution->joint = end_pose(segment_at(chain, 0)).position;
  return solution;
}

}  // namespace keyline::lac
