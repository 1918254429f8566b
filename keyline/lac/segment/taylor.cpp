#include "keyline/lac/segment/taylor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/numeric/newton_bracket.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac::detail {

using core::Vector2;

namespace {

using Scalars = std::array<double, kMaxTaylorDegree + 1>;

/// The power is a polynomial, so that the series has no end: -1/a is a whole number.
bool is_polynomial_power(double a) { return a < 0 && -1 / a == std::round(-1 / a); }

/// Coefficients of kappa or rho.
Scalars power_series(const TaylorSeries& s) {
  Scalars k{};
  k[0] = s.value;
  if (s.value == 0) {
    k[1] = s.rate;  // a = -1; all others vanish
    return k;
  }
  for (int j = 0; j + 1 < s.degree; ++j) k[j + 1] = k[j] * s.log_rate * (1 + j * s.decay) / (j + 1);
  return k;
}

/// e^{i theta}, theta the integral of the curvature: (j + 1) T_{j+1} = i sum of k_m T_{j-m}.
void integrate_arc(TaylorSeries& s) {
  const Scalars k = power_series(s);
  std::array<Vector2, kMaxTaylorDegree + 1> tangent{};
  tangent[0] = {1, 0};
  for (int j = 0; j + 1 < s.degree; ++j) {
    Vector2 total;
    for (int m = 0; m <= j; ++m) total = total + k[m] * tangent[j - m];
    tangent[j + 1] = core::perpendicular_left(total) / (j + 1);
  }
  for (int j = 0; j < s.degree; ++j) s.coefficient[j + 1] = tangent[j] / (j + 1);
}

/// rho e^{i theta}: a product of two series.
void integrate_angle(TaylorSeries& s) {
  const Scalars k = power_series(s);
  std::array<Vector2, kMaxTaylorDegree + 1> turn{};
  turn[0] = {1, 0};
  for (int j = 0; j + 1 < s.degree; ++j)
    turn[j + 1] = (s.turning / (j + 1)) * core::perpendicular_left(turn[j]);
  for (int j = 0; j < s.degree; ++j) {
    Vector2 total;
    for (int m = 0; m <= j; ++m) total = total + k[m] * turn[j - m];
    s.coefficient[j + 1] = total / (j + 1);
  }
}

/// The power with every coefficient made positive, at x < radius.
double majorant(const TaylorSeries& s, double x) {
  if (s.value == 0) return std::abs(s.rate) * x;
  const double step = s.decay * std::abs(s.log_rate) * x;
  const double power = s.decay == 0 ? std::abs(s.log_rate) * x : -std::log1p(-step) / s.decay;
  return std::abs(s.value) * std::exp(power);
}

/// Logarithm of a bound of the velocity on the circle |x| = r.
double log_velocity_bound(const TaylorSeries& s, double r) {
  const double largest = majorant(s, r);
  if (s.variable == SeriesVariable::tangent_angle) return std::log(largest) + s.turning * r;
  return s.value == 0 ? 0.5 * largest * r
                      : r * numeric::power_mean_integral(std::abs(s.value), largest, -s.decay, 1);
}

/// Rate by ln r of what log_velocity_bound tells, and the rate of its logarithm.
std::pair<double, double> velocity_growth(const TaylorSeries& s, double r) {
  if (s.value == 0) return {std::abs(s.rate) * r * r, 2};
  const double x = std::abs(s.log_rate) * r;
  const double q = x / (1 - s.decay * x);
  if (s.variable == SeriesVariable::arc_length) return {r * majorant(s, r), 1 + q};
  const double rate = q + s.turning * r;
  return {rate, (q * (1 + s.decay * q) + s.turning * r) / rate};
}

/// ln(r / reach) of the circle whose estimate is about the least. The logarithm of the estimate is
/// convex in ln r (as that of any largest modulus, by Hadamard's three circles): its rate, the
/// velocity's less degree + 1 / (r / reach - 1), has one zero. Newton's steps on the difference of
/// both logarithms, which is nearly straight, from near the rim, where the zero lies for large
/// degrees. Any circle gives a bound; where they differ by 0.3 it is some e^(degree / 20) times the
/// least, and circles larger than a million times the reach are not needed.
double best_growth(const TaylorSeries& s, double reach) {
  numeric::NewtonBracket between{0, std::log(std::min(s.radius / reach, 1e6))};
  double growth = 0.9 * between.high;
  for (int step = 0; step < 6; ++step) {
    const double less = std::expm1(growth);
    const auto [rate, rise] = velocity_growth(s, reach * (1 + less));
    const double fall = s.degree + 1 / less;
    const double off = std::log(rate / fall);
    if (std::abs(off) < 0.3) break;
    growth = between.next(growth, off, rise + (1 + less) / (less * less * fall));
  }
  return growth;
}

}  // namespace

UnitPiece unit_piece(const Piece& p) {
  UnitPiece u{{p.alpha, 1, p.curvature_start * p.length, p.curvature_end * p.length}, p.length};
  u.turning = total_turning(u.piece);
  if (u.turning < 0) {
    u.mirror = -1;
    u.turning = -u.turning;
    u.piece = mirrored(u.piece);
  }
  return u;
}

TaylorSeries taylor_series(const UnitPiece& unit, SeriesVariable variable, double about,
                           int degree) {
  TaylorSeries s;
  s.variable = variable;
  s.about = about;
  s.degree = degree;
  const bool by_angle = variable == SeriesVariable::tangent_angle;
  s.arc = by_angle ? fraction_at_turning(unit.piece, about) : about;
  const double kappa = curvature(unit.piece, s.arc);
  const double rate = curvature_rate(unit.piece, s.arc);
  s.turning = unit.turning;
  s.decay = by_angle ? 1 - unit.piece.alpha : unit.piece.alpha;
  if (by_angle) {
    s.value = unit.turning / kappa;
    s.log_rate = -rate / kappa * (unit.turning / kappa);
  } else {
    s.value = kappa;
    s.rate = rate;
    s.log_rate = kappa == 0 ? 0 : rate / kappa;
  }
  const bool vertex = s.value == 0 && s.rate != 0;  // inflection in arc length, cusp in angle
  s.analytic = std::isfinite(s.value) && std::isfinite(s.log_rate) && (!vertex || s.decay == -1) &&
               !(by_angle && s.value == 0);
  if (!s.analytic) return s;
  const double pace = std::abs(s.decay * s.log_rate);
  s.radius = pace == 0 || vertex || is_polynomial_power(s.decay)
                 ? std::numeric_limits<double>::infinity()
                 : 1 / pace;
  by_angle ? integrate_angle(s) : integrate_arc(s);
  return s;
}

Vector2 sum(const TaylorSeries& s, double x) {
  Vector2 v = s.coefficient[s.degree];
  for (int k = s.degree - 1; k > 0; --k) v = s.coefficient[k] + x * v;
  return x * v;
}

double remainder_bound(const TaylorSeries& s, double reach) {
  const double never = std::numeric_limits<double>::infinity();
  if (!s.analytic || !(reach < s.radius)) return never;
  if (reach == 0) return 0;
  const double n = s.degree + 1;
  const double growth = best_growth(s, reach);
  const double r = reach * std::exp(growth);
  return std::exp(log_velocity_bound(s, r) - n * growth) * r / (n * -std::expm1(-growth));
}

}  // namespace keyline::lac::detail
