#include "keyline/lac/segment/piece_shape.h"

#include <algorithm>

#include "keyline/core/angle.h"
#include "keyline/lac/segment/arm.h"
#include "keyline/numeric/quadrature.h"

namespace keyline::lac::detail {
namespace {

using core::Vector2;

/// Sums over the nodes of a rule: the chord and its derivatives by two parameters of the shape.
struct Sums {
  Vector2 chord;
  Vector2 by_first;
  Vector2 by_second;
};

/// Clothoid: the tangent angle is quadratic in the arc length.
template <std::size_t N>
Sums clothoid_sums(double k0, double k1) {
  constexpr const auto& rule = numeric::gauss_legendre<N>;
  Sums sum;
  for (std::size_t i = 0; i < N; ++i) {
    const double t = rule.nodes[i];
    const double late = 0.5 * t * t;
    const double angle = k0 * (t - late) + k1 * late;
    const Vector2 f{rule.weights[i] * std::cos(angle), rule.weights[i] * std::sin(angle)};
    sum.chord = sum.chord + f;
    sum.by_first = sum.by_first + (t - late) * core::perpendicular_left(f);
    sum.by_second = sum.by_second + late * core::perpendicular_left(f);
  }
  return sum;
}

/// Factor dkappa/dx of the variable x; a power's variable is not used at kappa = 0.
double rate_of(double kappa, const CurvatureVariable& v) {
  if (v.step == CurvatureStep::fixed) return 0;
  if (v.step == CurvatureStep::linear) return 1;
  if (v.step == CurvatureStep::logarithm) return kappa;
  return std::pow(std::abs(kappa), 1 - v.power) / v.power;
}

void add_length_derivative(PieceShape& shape, double k0, double k1, Vector2 by0, Vector2 by1) {
  shape.chord_by_length = shape.chord + k0 * by0 + k1 * by1;
}

PieceShape clothoid_shape(double k0, double k1, const CurvatureVariable& v0,
                          const CurvatureVariable& v1) {
  const double size = std::max(std::abs(k0), std::abs(k1));
  const Sums sum = size < 0.3   ? clothoid_sums<6>(k0, k1)
                   : size < 1.4 ? clothoid_sums<9>(k0, k1)
                   : size < 7   ? clothoid_sums<16>(k0, k1)
                                : clothoid_sums<40>(k0, k1);
  const double r0 = rate_of(k0, v0);
  const double r1 = rate_of(k1, v1);
  PieceShape shape{sum.chord,
                   0.5 * (k0 + k1),
                   {r0 * sum.by_first, r1 * sum.by_second},
                   {0.5 * r0, 0.5 * r1},
                   {}};
  add_length_derivative(shape, k0, k1, sum.by_first, sum.by_second);
  return shape;
}

/// e1(y) = (e^y - 1)/y and its derivative; the derivative to 1e-11.
struct Growth {
  double value;
  double slope;
};
Growth growth(double y) {
  if (std::abs(y) < 1e-3) {
    return {1 + y * (0.5 + y * (1.0 / 6 + y * (1.0 / 24 + y / 120))),
            0.5 + y * (1.0 / 3 + y * (0.125 + y / 30))};
  }
  const double e = std::expm1(y);
  return {e / y, (1 + e - e / y) / y};
}

/// Piece of one sign of curvature, integrated in x = ln(kappa/k0) / Q, Q = ln(k1/k0): arc length
/// goes as e^{A Q x}, tangent angle as e^{B Q x}, with A = -alpha, B = 1 - alpha.
/// Derivatives by ln k0 at fixed Q, and by Q.
template <std::size_t N>
Sums logarithmic_sums(double alpha, double k0, double q) {
  constexpr const auto& rule = numeric::gauss_legendre<N>;
  const double a = -alpha * q;
  const double b = (1 - alpha) * q;
  const Growth whole = growth(a);
  const double whole_by_q = -alpha * whole.slope / whole.value;
  const double scale = k0 / whole.value;
  Sums sum;
  for (std::size_t i = 0; i < N; ++i) {
    const double x = rule.nodes[i];
    const Growth turned = growth(b * x);
    const double angle = scale * x * turned.value;
    const double by_q = scale * x * x * (1 - alpha) * turned.slope - angle * whole_by_q;
    const double weight = rule.weights[i] * std::exp(a * x) / whole.value;
    const double weight_by_q = -alpha * x - whole_by_q;
    const Vector2 f{weight * std::cos(angle), weight * std::sin(angle)};
    const Vector2 n = core::perpendicular_left(f);
    sum.chord = sum.chord + f;
    sum.by_first = sum.by_first + angle * n;
    sum.by_second = sum.by_second + weight_by_q * f + by_q * n;
  }
  return sum;
}

PieceShape logarithmic_shape(double alpha, double k0, double k1, const CurvatureVariable& v0,
                             const CurvatureVariable& v1) {
  const double q = numeric::log_ratio(std::abs(k0), std::abs(k1));
  const double range = std::max(std::abs(alpha), std::abs(1 - alpha)) * std::abs(q);
  const double size = std::max(std::abs(k0), std::abs(k1));
  const Sums sum = range < 1.5 && size < 1 ? logarithmic_sums<10>(alpha, k0, q)
                   : range + size < 6      ? logarithmic_sums<16>(alpha, k0, q)
                                           : logarithmic_sums<32>(alpha, k0, q);
  const Growth arc = growth(-alpha * q);
  const Growth angle = growth((1 - alpha) * q);
  const double turning = k0 * angle.value / arc.value;
  const double turning_by_q =
      turning * ((1 - alpha) * angle.slope / angle.value + alpha * arc.slope / arc.value);
  // By ln k0 and ln k1, then by the variables asked for.
  const double l0 = rate_of(k0, v0) / k0;
  const double l1 = rate_of(k1, v1) / k1;
  PieceShape shape{sum.chord,
                   turning,
                   {l0 * (sum.by_first - sum.by_second), l1 * sum.by_second},
                   {l0 * (turning - turning_by_q), l1 * turning_by_q},
                   {}};
  shape.chord_by_length = shape.chord + sum.by_first;
  return shape;
}

/// Product of two vectors as complex numbers, and the conjugate.
Vector2 times(Vector2 a, Vector2 b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
Vector2 conjugate(Vector2 a) { return {a.x, -a.y}; }

/// Piece of slope alpha < 0 seen from its inflection, which may lie outside: z = kappa^p is linear
/// in the arc length and zero there.
struct InflectionFrame {
  double p = 1;
  double m = 2;
  std::array<double, 2> z{};
  std::array<double, 2> arm{};     ///< signed lengths: start to inflection, inflection to end
  std::array<double, 2> turned{};  ///< turning over them

  InflectionFrame(double alpha, double k0, double k1) : p(-alpha), m(1 - 1 / alpha) {
    z = {numeric::signed_power(k0, p), numeric::signed_power(k1, p)};
    const double change = z[1] - z[0];
    arm = {-z[0] / change, z[1] / change};
    turned = {k0 * arm[0] / m, k1 * arm[1] / m};
  }
  bool serves() const {
    const double farthest = std::max(std::abs(arm[0]), std::abs(arm[1]));
    const double most = std::max(std::abs(turned[0]), std::abs(turned[1]));
    return p < 60 && farthest < 1.6 && most < kLargestSeriesTurning;
  }
};

/// dz/dx of the variable x, p the power of z.
double z_rate_of(double kappa, double size, double p, const CurvatureVariable& v) {
  if (v.step == CurvatureStep::fixed) return 0;
  if (v.step == CurvatureStep::power && v.power == p) return 1;
  const double k = std::max(std::abs(kappa), 1e-9 * size);
  const double by_kappa = p * std::pow(k, p - 1);
  if (v.step == CurvatureStep::power) return by_kappa * std::pow(k, 1 - v.power) / v.power;
  return v.step == CurvatureStep::linear ? by_kappa : by_kappa * kappa;
}

PieceShape inflection_shape(const InflectionFrame& f, double k0, double k1,
                            const CurvatureVariable& v0, const CurvatureVariable& v1) {
  const InflectionArm first = inflection_arm(f.turned[0], f.m);
  const InflectionArm second = inflection_arm(f.turned[1], f.m);
  const Vector2 frame = core::unit_vector(f.turned[0]);
  const double size = std::max(std::abs(k0), std::abs(k1));
  const double change = f.z[1] - f.z[0];
  PieceShape shape;
  shape.turning = f.turned[0] + f.turned[1];
  shape.chord = times(frame, f.arm[0] * conjugate(first.chord) + f.arm[1] * second.chord);
  // The chord's change when the arms lengthen and turn by the given rates.
  const auto chord_by = [&](double arm0, double turned0, double turned1) {
    const Vector2 inner = arm0 * (conjugate(first.chord) - second.chord) +
                          (f.arm[0] * turned0) * conjugate(first.by_turned) +
                          (f.arm[1] * turned1) * second.by_turned;
    return times(frame, inner) + turned0 * core::perpendicular_left(shape.chord);
  };
  const double u0 = k0 / (f.m * change);
  const double u1 = k1 / (f.m * change);
  const double r0 = z_rate_of(k0, size, f.p, v0);
  const double r1 = z_rate_of(k1, size, f.p, v1);
  const double t00 = -u0 * (1 / f.p + f.arm[1]);
  const double t01 = -u0 * f.arm[0];
  const double t10 = u1 * f.arm[1];
  const double t11 = u1 * (1 / f.p + f.arm[0]);
  shape.chord_by = {r0 * chord_by(-f.arm[1] / change, t00, t10),
                    r1 * chord_by(-f.arm[0] / change, t01, t11)};
  shape.turning_by = {r0 * (t00 + t10), r1 * (t01 + t11)};
  shape.chord_by_length = shape.chord + chord_by(0, f.turned[0], f.turned[1]);
  return shape;
}

/// Any other piece: values from the segment's own exact functions, derivatives by differences.
PieceShape general_shape(double alpha, double k0, double k1, const CurvatureVariable& v0,
                         const CurvatureVariable& v1) {
  const auto end = [&](double from, double to, Vector2& chord, double& turning) {
    const Piece piece{alpha, 1, from, to};
    chord = displacement(piece, 1);
    turning = total_turning(piece);
  };
  PieceShape shape;
  end(k0, k1, shape.chord, shape.turning);
  const double size = std::max({std::abs(k0), std::abs(k1), 1e-9});
  const auto difference = [&](int which, const CurvatureVariable& v, double h, Vector2& by,
                              double& turning_by) {
    std::array<Vector2, 2> chord;
    std::array<double, 2> turning{};
    const double k = which == 0 ? k0 : k1;
    double apart = 0;
    for (int side = 0; side < 2; ++side) {
      double moved = stepped(k, side == 0 ? -h : h, v);
      const bool inflects = alpha >= 0 && moved * k < 0;  // which no piece of this slope does
      if (inflects) moved = k;
      if (!inflects) apart += h;
      end(which == 0 ? moved : k0, which == 1 ? moved : k1, chord[side], turning[side]);
    }
    by = (chord[1] - chord[0]) / apart;
    turning_by = (turning[1] - turning[0]) / apart;
  };
  // Of a power the width that changes the larger curvature by a millionth, however flat the power.
  const auto width = [size](const CurvatureVariable& v) {
    return 1e-6 * (v.step == CurvatureStep::power ? std::min(1.0, v.power) * std::pow(size, v.power)
                   : v.step == CurvatureStep::linear ? size
                                                     : 1.0);
  };
  if (v0.step != CurvatureStep::fixed)
    difference(0, v0, width(v0), shape.chord_by[0], shape.turning_by[0]);
  if (v1.step != CurvatureStep::fixed)
    difference(1, v1, width(v1), shape.chord_by[1], shape.turning_by[1]);
  // Growing keeps the ratio of the curvatures.
  const double h = 1e-6;
  Vector2 more;
  Vector2 less;
  double ignored = 0;
  end(k0 * (1 + h), k1 * (1 + h), more, ignored);
  end(k0 * (1 - h), k1 * (1 - h), less, ignored);
  shape.chord_by_length = shape.chord + (more - less) / (2 * h);
  return shape;
}

}  // namespace

PieceShape piece_shape(double alpha, double k0, double k1, const CurvatureVariable& v0,
                       const CurvatureVariable& v1) {
  const double size = std::max(std::abs(k0), std::abs(k1));
  const bool plain = v0.step != CurvatureStep::power && v1.step != CurvatureStep::power;
  if (alpha == -1 && size < 30 && plain) return clothoid_shape(k0, k1, v0, v1);
  if (k0 * k1 > 0 && size < 8) {
    const double decay = std::max(std::abs(alpha), std::abs(1 - alpha));
    if (decay * std::abs(std::log(k1 / k0)) < 10) return logarithmic_shape(alpha, k0, k1, v0, v1);
  }
  if (alpha < 0 && k0 != k1) {
    const InflectionFrame frame(alpha, k0, k1);
    if (frame.serves()) return inflection_shape(frame, k0, k1, v0, v1);
  }
  return general_shape(alpha, k0, k1, v0, v1);
}

double absolute_turning(const Piece& piece) {
  const double at = inflection(piece);
  if (at < 0) return std::abs(total_turning(piece));
  return std::abs(turning(piece, at)) + std::abs(total_turning(piece) - turning(piece, at));
}

double bending_energy(const Piece& piece) {
  const double root = std::sqrt(piece.length);  // first: the squares alone may be too large
  const auto squared = [&](double t) {
    const double k = root * curvature(piece, t);
    return k * k;
  };
  double low = 0;
  double sum = 0;
  for (const double high : {0.02, 0.1, 0.3, 0.7, 0.9, 0.98, 1.0}) {
    sum += numeric::integrate_gauss<8>(squared, low, high);
    low = high;
  }
  return sum;
}

}  // namespace keyline::lac::detail
