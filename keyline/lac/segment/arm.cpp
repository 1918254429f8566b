#include "keyline/lac/segment/arm.h"

#include <algorithm>

#include "keyline/core/angle.h"
#include "keyline/lac/lanes/chord_lanes.h"

namespace keyline::lac::detail {
namespace {

using core::Vector2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// e^-kNegligible is far below the spacing of doubles.
constexpr double kNegligible = 39;

/// Arm over fractions [from, to] of a piece whose curvature keeps its sign there.
Arm make_arm(double alpha, double length, double start, double end, double from, double to) {
  Arm arm;
  const double k0 = std::abs(start);
  const double k1 = std::abs(end);
  const bool decreasing = k0 > k1;
  arm.a = std::abs(alpha);
  arm.b = alpha < 0 ? 1 - alpha : alpha - 1;
  arm.backward = alpha < 0 ? !decreasing && k0 != k1 : decreasing;
  arm.length = length * (to - from);
  arm.from = from;
  arm.to = to;
  if (k0 == 0 && k1 == 0) return arm;
  const double heavy = alpha < 0 ? std::max(k0, k1) : std::min(k0, k1);
  const bool endless = k0 == 0 || k1 == 0 || std::isinf(k0) || std::isinf(k1);
  arm.range = endless ? kInfinity : std::abs(numeric::log_ratio(k0, k1));
  arm.arc_total = decay_integral(arm.a, arm.range);
  arm.angle_total = decay_integral(arm.b, arm.range);
  const double mean = arm.range == 0 ? heavy : heavy * (arm.angle_total / arm.arc_total);
  const double sign = start + end > 0 ? 1 : -1;
  arm.turning = (arm.backward ? -sign : sign) * mean * arm.length;
  if (arm.range == 0) arm.arc_total = arm.angle_total = 1;
  return arm;
}

/// ln of a fraction in (0, 1] given with its complement.
double log_fraction(double fraction, double complement) {
  return complement < 0.5 ? std::log1p(-complement) : std::log(fraction);
}

}  // namespace

double Arm::lambda_at(double fraction, double complement) const {
  if (range == 0 || fraction <= 0) return 0;
  if (complement <= 0) return range;
  if (a == 0) return fraction * range;
  if (std::isinf(range)) return -log_fraction(complement, fraction) / a;
  const double lost = fraction * a * arc_total;  // 1 - e^{-a lambda}
  if (lost < 0.5) return std::min(range, -std::log1p(-lost) / a);
  return std::min(range, -std::log(complement + fraction * std::exp(-a * range)) / a);
}

Arms arms_of(const Piece& piece) {
  Arms arms;
  const double at = inflection(piece);
  const auto add = [&](double start, double end, double from, double to) {
    arms.arm[arms.count++] = make_arm(piece.alpha, piece.length, start, end, from, to);
  };
  if (at > 0) {
    add(piece.curvature_start, 0, 0, at);
    add(0, piece.curvature_end, at, 1);
  } else {
    add(piece.curvature_start, piece.curvature_end, 0, 1);
  }
  return arms;
}

PanelWalk::PanelWalk(const Arm& arm, double end, double exponent, double angle)
    : arm_(arm), end_(end), exponent_(exponent), angle_(angle) {
  if (arm.b > 0) {
    tail_ = std::min(end, kNegligible / (arm.a + arm.b));
  } else {
    tail_ = arm.a > 0 ? std::min(end, kNegligible / arm.a) : end;
    if (arm.b < 0) head_ = std::clamp(arm.range - kNegligible / -arm.b, 0.0, tail_);
  }
}

double PanelWalk::step_from(double lambda) const {
  double step = exponent_ / std::max({arm_.a, std::abs(arm_.b), 1e-300});
  const double total = std::abs(arm_.turning);
  const auto rate = [&](double x) { return total * std::exp(-arm_.b * x) / arm_.angle_total; };
  if (arm_.b >= 0) {
    step = std::min(step, angle_ / rate(lambda));
  } else {
    step = std::min(step, end_ - lambda);
    while (rate(lambda + step) * step > angle_) step *= 0.7;
  }
  return step;
}

bool PanelWalk::next(Panel& panel) {
  if (!(at_ < end_)) return false;
  panel.from = at_;
  panel.straight = at_ < head_ || at_ >= tail_;
  if (at_ < head_) {
    panel.to = std::min(head_, end_);
  } else if (at_ >= tail_) {
    panel.to = end_;
  } else {
    const double step = step_from(at_);
    const double left = tail_ - at_;
    panel.to = step < left ? at_ + left / std::ceil(left / step) : tail_;
    if (!(panel.to > at_)) panel.to = tail_;
  }
  at_ = panel.to;
  return true;
}

namespace {

PanelMoments straight_moments(const Arm& arm, const Panel& panel) {
  const double angle = panel.from == 0 ? 0.0 : arm.turning * arm.angle_fraction(panel.from);
  const double arc = decay_integral(arm.a, panel.to) - decay_integral(arm.a, panel.from);
  const Vector2 sum = arc * core::unit_vector(angle);
  return {sum, angle * sum};
}

/// A circular arc or a straight line: sin(x)/x in closed form.
Vector2 arc_vector(double turning, double fraction) {
  const double half = turning * fraction / 2;
  const double chord = half == 0 ? 1 : std::sin(half) / half;
  return {fraction * chord * std::cos(half), fraction * chord * std::sin(half)};
}

}  // namespace

PanelMoments panel_moments(const Arm& arm, const Panel& panel) {
  if (panel.straight) return straight_moments(arm, panel);
  const double scale = arm.turning / arm.angle_total;
  const double from = scale * decay_integral(arm.b, panel.from);
  const double to = scale * decay_integral(arm.b, panel.to);
  const double centre = (from + to) / 2;
  const double width = panel.to - panel.from;
  const double reach = std::max(arm.a, std::abs(arm.b)) * width + std::abs(to - from);
  const PanelSums s =
      panel_sums({arm.a, arm.b, panel.from, width, scale, centre, nodes_for(reach)});
  return {core::rotate_ccw({s.x, s.y}, centre), core::rotate_ccw({s.angle_x, s.angle_y}, centre)};
}

Vector2 arm_vector(const Arm& arm, double lambda) {
  PanelWalk walk(arm, lambda, 6.5, 3.2);
  Panel panel;
  Vector2 sum;
  while (walk.next(panel)) sum = sum + panel_moments(arm, panel).zeroth;
  return sum / arm.arc_total;
}

InflectionArm inflection_arm(double turned, double m) {
  // The exponential's series, term by term.
  InflectionArm arm{{1, 0}, {0, 0}};
  Vector2 term{1, 0};  // (i turned)^(k-1) / (k-1)!
  for (int k = 1; k < 60; ++k) {
    const double share = 1 / (m * k + 1);
    arm.by_turned = arm.by_turned + share * core::perpendicular_left(term);
    term = (turned / k) * core::perpendicular_left(term);
    arm.chord = arm.chord + share * term;
    if (std::abs(term.x) + std::abs(term.y) < 1e-18) break;
  }
  return arm;
}

Vector2 arm_vector_at(const Arm& arm, double fraction, double complement) {
  if (arm.range == 0) return arc_vector(arm.turning, fraction);
  const bool inflects = std::isinf(arm.range) && arm.b > arm.a && arm.a > 0;
  if (inflects && std::abs(arm.turning) < kLargestSeriesTurning) {
    // From the inflection, where the tangent angle goes as the power m of the distance.
    const double m = 1 + 1 / arm.a;
    const Vector2 whole = inflection_arm(-arm.turning, m).chord;
    if (complement <= 0) return core::rotate_ccw(whole, arm.turning);
    const double turned = -arm.turning * std::pow(complement, m);
    const Vector2 rest = complement * inflection_arm(turned, m).chord;
    return core::rotate_ccw(whole - rest, arm.turning);
  }
  return arm_vector(arm, arm.lambda_at(fraction, complement));
}

double arm_angle_at(const Arm& arm, double fraction, double complement) {
  if (arm.range == 0) return arm.turning * fraction;
  return arm.turning * arm.angle_fraction(arm.lambda_at(fraction, complement));
}

}  // namespace keyline::lac::detail
