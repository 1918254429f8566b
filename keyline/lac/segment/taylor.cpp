#include "keyline/lac/segment/taylor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/core/angle.h"
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

/// Bound of the velocity on the circle |x| = r.
double velocity_bound(const TaylorSeries& s, double r) {
  const double largest = majorant(s, r);
  if (s.variable == SeriesVariable::tangent_angle) return largest * std::exp(s.turning * r);
  const double angle =
      s.value == 0 ? 0.5 * largest * r
                   : r * numeric::power_mean_integral(std::abs(s.value), largest, -s.decay, 1);
  return std::exp(angle);
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

double quick_remainder_bound(const TaylorSeries& s, double reach) {
  if (!s.analytic || !(reach < s.radius)) return std::numeric_limits<double>::infinity();
  // Far out in the circle, yet where the velocity is still of size one.
  const double pace = std::abs(s.value) + std::sqrt(std::abs(s.rate)) + s.turning;
  const double r = std::min(std::max(0.85 * s.radius, std::sqrt(reach * s.radius)),
                            std::max(0.4 * s.degree / std::max(pace, 1e-3), 2 * reach));
  if (!(r > reach) || !(r < s.radius)) return std::numeric_limits<double>::infinity();
  const double shrink = reach / r;
  return velocity_bound(s, r) * r * std::pow(shrink, s.degree + 1) /
         ((s.degree + 1) * (1 - shrink));
}

double remainder_bound(const TaylorSeries& s, double reach) {
  const double never = std::numeric_limits<double>::infinity();
  if (!s.analytic || !(reach < s.radius)) return never;
  if (reach == 0) return 0;
  const double n = s.degree;
  double best = never;
  double ratio = std::isinf(s.radius) ? 1e3 : std::min(s.radius / reach, 1e3);
  ratio = std::log(ratio);
  for (int i = 1; i <= 24; ++i) {
    const double growth = ratio * i / (std::isinf(s.radius) ? 24.0 : 24.5);
    const double r = reach * std::exp(growth);
    const double bound =
        velocity_bound(s, r) * r * std::exp(-(n + 1) * growth) / ((n + 1) * -std::expm1(-growth));
    if (bound < best) best = bound;
  }
  return best;
}

}  // namespace keyline::lac::detail
