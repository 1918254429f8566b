#include "keyline/lac/segment/segment.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/lac/segment/arm.h"
#include "keyline/lac/segment/slope.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point2;
using core::Pose2;
using core::Vector2;

bool is_straight(const Piece& p) { return p.curvature_start == 0 && p.curvature_end == 0; }

double sign_of(const Piece& p) { return p.curvature_start + p.curvature_end < 0 ? -1.0 : 1.0; }

/// The curvature rule of Piece that is broken, or nothing.
const char* broken_rule(const Piece& p) {
  const double k0 = p.curvature_start;
  const double k1 = p.curvature_end;
  if (std::isnan(k0) || std::isnan(k1)) return "a curvature is not a number";
  if (is_straight(p)) return nullptr;
  if (p.alpha >= 0) {
    if (k0 == 0 || k1 == 0) return "zero curvature at one end needs a slope alpha below 0";
    if (std::signbit(k0) != std::signbit(k1)) return "an inflection needs a slope alpha below 0";
  }
  const int cusps = static_cast<int>(std::isinf(k0)) + static_cast<int>(std::isinf(k1));
  if (cusps > 0 && !(p.alpha > 1)) return "infinite curvature needs a slope alpha above 1";
  if (cusps > 1) return "both ends have infinite curvature";
  return nullptr;
}

/// dkappa/dt for one sign of curvature, in units of the start curvature.
double scaled_rate(double alpha, double k0, double k1, double t) {
  const double l = numeric::log_ratio(k0, k1);
  const double x = -alpha * l;
  const double relative = x > 0 ? l * numeric::expm1_over(-x) / ((1 - t) * std::exp(-x) + t)
                                : l * numeric::expm1_over(x) / ((1 - t) + t * std::exp(x));
  return relative * numeric::power_mean(k0, k1, -alpha, t);
}

/// dkappa/dt where the power of the curvature is linear with a zero in or at the end of [0, 1].
double rate_through_zero(double alpha, double k0, double k1, double t) {
  const double p = -alpha;
  const double size = std::max(std::abs(k0), std::abs(k1));
  const double from = numeric::signed_power(k0 / size, p);
  const double to = numeric::signed_power(k1 / size, p);
  const double g = std::abs((1 - t) * from + t * to);
  return size * (to - from) / p * std::pow(g, 1 / p - 1);
}

double clamp01(double t) { return std::clamp(t, 0.0, 1.0); }

/// Vector from the start of the arm (in the piece's direction) to fraction f of the arm, in the
/// frame of the tangent there, and the tangent angle.
struct Reached {
  Vector2 vector;
  double angle = 0;
};
Reached reach(const detail::Arm& arm, double f) {
  if (!arm.backward) {
    return {arm.length * detail::arm_vector_at(arm, f, 1 - f), detail::arm_angle_at(arm, f, 1 - f)};
  }
  const Vector2 all = detail::arm_vector_at(arm, 1, 0);
  const Vector2 rest = detail::arm_vector_at(arm, 1 - f, f);
  const double angle = detail::arm_angle_at(arm, 1 - f, f) - arm.turning;
  return {arm.length * core::rotate_ccw(all - rest, -arm.turning), angle};
}

}  // namespace

core::Result<void> validate(const Piece& piece) {
  const auto bad = [](const char* message) { return core::fail(ErrorCode::bad_input, message); };
  if (!is_slope(piece.alpha)) return bad(kSlopeRule);
  if (!(piece.length > 0) || std::isinf(piece.length)) return bad("the length must be positive");
  if (const char* rule = broken_rule(piece)) return bad(rule);
  if (!(std::abs(total_turning(piece)) <= kLargestTurning)) {
    return bad("the piece turns by more than 1e5 radians");
  }
  return {};
}

core::Result<void> validate(const Segment& segment) {
  if (!is_finite(segment.start.position) || !std::isfinite(segment.start.direction)) {
    return core::fail(ErrorCode::bad_input, "the start pose must be finite");
  }
  return validate(piece_of(segment));
}

double curvature(const Piece& p, double t) {
  t = clamp01(t);
  if (p.alpha < 0) {
    return numeric::signed_power_mean(p.curvature_start, p.curvature_end, -p.alpha, t);
  }
  return sign_of(p) *
         numeric::power_mean(std::abs(p.curvature_start), std::abs(p.curvature_end), -p.alpha, t);
}

double curvature_rate(const Piece& p, double t) {
  t = clamp01(t);
  const double k0 = p.curvature_start;
  const double k1 = p.curvature_end;
  if (k0 == k1) return 0;
  const bool plain = k0 != 0 && k1 != 0 && std::signbit(k0) == std::signbit(k1) &&
                     std::isfinite(k0) && std::isfinite(k1);
  if (plain) return sign_of(p) * scaled_rate(p.alpha, std::abs(k0), std::abs(k1), t) / p.length;
  if (std::isfinite(k0) && std::isfinite(k1)) {
    return rate_through_zero(p.alpha, k0, k1, t) / p.length;
  }
  // A cusp: kappa = k w^(-1/alpha), w the fraction of the length from it.
  const double w = std::isinf(k0) ? t : 1 - t;
  const double k = std::isinf(k0) ? k1 : k0;
  const double rate = -k / p.alpha * std::pow(w, -1 / p.alpha - 1) / p.length;
  return std::isinf(k0) ? rate : -rate;
}

double turning(const Piece& p, double t) {
  t = clamp01(t);
  if (is_straight(p)) return 0;
  if (p.alpha < 0) {
    return p.length *
           numeric::signed_power_mean_integral(p.curvature_start, p.curvature_end, -p.alpha, t);
  }
  return sign_of(p) * p.length *
         numeric::power_mean_integral(std::abs(p.curvature_start), std::abs(p.curvature_end),
                                      -p.alpha, t);
}

double total_turning(const Piece& p) { return turning(p, 1); }

double fraction_at_turning(const Piece& p, double u) {
  u = clamp01(u);
  if (is_straight(p)) return u;
  const double r0 = 1 / std::abs(p.curvature_start);
  const double r1 = 1 / std::abs(p.curvature_end);
  if (r0 == r1) return u;
  const double size = std::isinf(r0) || (std::isfinite(r1) && r1 < r0) ? r1 : r0;
  const double unit = size > 0 ? size : std::max(r0, r1);
  return clamp01(numeric::power_mean_integral(r0 / unit, r1 / unit, p.alpha - 1, u) /
                 numeric::power_mean_integral(r0 / unit, r1 / unit, p.alpha - 1, 1));
}

double inflection(const Piece& p) {
  const double k0 = p.curvature_start;
  const double k1 = p.curvature_end;
  if (!(p.alpha < 0) || k0 == 0 || k1 == 0 || std::signbit(k0) == std::signbit(k1)) return -1;
  const double size = std::max(std::abs(k0), std::abs(k1));
  const double from = std::pow(std::abs(k0) / size, -p.alpha);
  const double to = std::pow(std::abs(k1) / size, -p.alpha);
  const double at = from / (from + to);
  return at > 0 && at < 1 ? at : -1;
}

Vector2 displacement(const Piece& piece, double t) {
  t = clamp01(t);
  Vector2 at;
  double angle = 0;
  const detail::Arms arms = detail::arms_of(piece);
  for (int i = 0; i < arms.count; ++i) {
    const detail::Arm& arm = arms.arm[i];
    const double f = t >= arm.to ? 1 : std::max(0.0, (t - arm.from) / (arm.to - arm.from));
    const Reached r = reach(arm, f);
    at = at + core::rotate_ccw(r.vector, angle);
    angle += r.angle;
    if (t <= arm.to) break;
  }
  return at;
}

Piece part(const Piece& p, double t0, double t1) {
  t0 = clamp01(t0);
  t1 = clamp01(t1);
  return {p.alpha, p.length * (t1 - t0), curvature(p, t0), curvature(p, t1)};
}

Piece reversed(const Piece& p) { return {p.alpha, p.length, -p.curvature_end, -p.curvature_start}; }

Piece mirrored(const Piece& p) { return {p.alpha, p.length, -p.curvature_start, -p.curvature_end}; }

double curvature(const Segment& s, double t) { return curvature(piece_of(s), t); }
double curvature_rate(const Segment& s, double t) { return curvature_rate(piece_of(s), t); }
double tangent_angle(const Segment& s, double t) {
  return s.start.direction + turning(piece_of(s), t);
}
double total_turning(const Segment& s) { return total_turning(piece_of(s)); }

Point2 evaluate(const Segment& s, double t) {
  const Vector2 v = displacement(piece_of(s), t);
  return from_local(s.start, {v.x, v.y});
}

curve::Jet2 jet(const Segment& s, double t) { return jet_from(s, t, evaluate(s, t)); }

curve::Jet2 jet_from(const Segment& s, double t, Point2 point) {
  const auto finite_or_zero = [](double x) { return std::isfinite(x) ? x : 0.0; };
  const Vector2 tangent = core::unit_vector(tangent_angle(s, t));
  const Vector2 normal = core::perpendicular_left(tangent);
  const double kappa = finite_or_zero(curvature(s, t)) * s.length;
  const double rate = finite_or_zero(curvature_rate(s, t)) * s.length * s.length;
  return {point, s.length * tangent, s.length * kappa * normal,
          s.length * (rate * normal - kappa * kappa * tangent)};
}

std::vector<double> breakpoints(const Segment& s) {
  const double at = inflection(piece_of(s));
  return at > 0 ? std::vector<double>{0, at, 1} : std::vector<double>{0, 1};
}

Pose2 pose_at(const Segment& s, double t) { return {evaluate(s, t), tangent_angle(s, t)}; }

Pose2 end_pose(const Segment& s) { return pose_at(s, 1); }

Segment part(const Segment& s, double t0, double t1) {
  return place(part(piece_of(s), t0, t1), pose_at(s, t0));
}

Segment reverse(const Segment& s) {
  const Pose2 end = end_pose(s);
  return place(reversed(piece_of(s)), {end.position, core::wrap_angle(end.direction + core::kPi)});
}

SegmentPair split(const Segment& s, double t) { return {part(s, 0, t), part(s, t, 1)}; }

Segment transform(const Segment& s, const core::Similarity2& map) {
  return {{apply(map, s.start.position), s.start.direction + map.rotation},
          s.alpha,
          s.length * map.scale,
          s.curvature_start / map.scale,
          s.curvature_end / map.scale};
}

core::Result<Segment> evolute(const Segment& s) {
  const double k0 = s.curvature_start;
  const double k1 = s.curvature_end;
  const bool plain = k0 * k1 > 0 && std::isfinite(k0) && std::isfinite(k1);
  if (!plain || k0 == k1) {
    return core::fail(ErrorCode::bad_input,
                      "the evolute needs a curvature that changes and is never zero or infinite");
  }
  const auto curvature_of_evolute = [&](double k, double t) {
    return k * k * (k / std::abs(curvature_rate(s, t)));
  };
  const Vector2 normal = core::perpendicular_left(core::unit_vector(s.start.direction));
  const double outward = 1 / k1 > 1 / k0 ? 0.5 : -0.5;
  const double slope = s.alpha == 2 ? 0 : 1 / (2 - s.alpha);
  return Segment{{s.start.position + normal / k0, s.start.direction + outward * core::kPi},
                 slope,
                 std::abs(1 / k1 - 1 / k0),
                 curvature_of_evolute(k0, 0),
                 curvature_of_evolute(k1, 1)};
}

}  // namespace keyline::lac
