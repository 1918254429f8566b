#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/core/angle.h"
#include "keyline/lac/cad/cad_cubic.h"

namespace keyline::lac::detail {
namespace {

using core::Vector2;

constexpr int kMapDegree = 3;
constexpr int kCarried = 3 * kMapDegree;
/// Of the polynomial (cubic - curve) x velocity.
constexpr int kDegree = SeriesTable::kDegree + SeriesTable::kDegree - 1;
static_assert(kCarried <= SeriesTable::kDegree);
constexpr int kFineNodes = 64;
constexpr int kFineDegree = 12;

/// Chebyshev's nodes, and the polynomials at the first half of them: at the mirrored node an even
/// polynomial is the same and an odd one the opposite.
template <int Nodes, int Degree>
struct Chebyshev {
  static_assert(Nodes % 2 == 0);
  std::array<double, Nodes> node;
  std::array<std::array<double, Nodes / 2>, Degree + 1> polynomial;

  static const Chebyshev& table() {
    static const Chebyshev made = [] {
      Chebyshev c;
      for (int j = 0; j < Nodes; ++j) c.node[j] = std::cos(core::kPi * (j + 0.5) / Nodes);
      for (int k = 0; k <= Degree; ++k)
        for (int j = 0; j < Nodes / 2; ++j)
          c.polynomial[k][j] = std::cos(core::kPi * k * (j + 0.5) / Nodes);
      return c;
    }();
    return made;
  }
};

/// t as polynomial of x in [-1, 1]: (1 + x) / 2 + (1 - x^2) (k0 + k1 x), through two feet.
/// Within [0, 1] because |k0 + k1 x| <= 1/4 (else both 0).
struct ParameterMap {
  double k0 = 0, k1 = 0;
};

ParameterMap parameter_map(const SeriesTable& table, double v0, double v1, const Cubic& c) {
  constexpr double p = 0.5;
  const auto off = [&](double x) {
    const double v = v0 + (v1 - v0) * 0.5 * (1 + x);
    const Vector2 at = table.point(v);
    const Vector2 d = table.velocity(v);
    double t = 0.5 * (1 + x);
    for (int i = 0; i < 2; ++i) t = step_foot(c, at, d, t);
    return (t - 0.5 * (1 + x)) / ((1 - x) * (1 + x));
  };
  const double low = off(-p);
  const double high = off(p);
  const ParameterMap map{0.5 * (low + high), 0.5 * (high - low) / p};
  return std::abs(map.k0) + std::abs(map.k1) <= 0.25 ? map : ParameterMap{};
}

/// Difference D = cubic - curve and velocity C' at the nodes of [w0, w1].
template <int Nodes>
struct NodeValues {
  std::array<double, Nodes> across;  ///< D x C'
  std::array<double, Nodes> square;  ///< |D|^2
  double pace = 0;                   ///< largest ||C'|^2 - 1|
};

template <int Nodes>
NodeValues<Nodes> node_values(const SeriesTable::Stretch& s, double w0, double w1, double v0,
                              double v1, const Cubic& c, const ParameterMap& map) {
  const auto& nodes = Chebyshev<Nodes, Nodes - 1>::table().node;
  const Vector2 origin = c.control[0];
  const Vector2 c1 = 3 * (c.control[1] - origin);
  const Vector2 c2 = 3 * (c.control[2] - origin) - 2 * c1;
  const Vector2 c3 = c.control[3] - origin - c1 - c2;
  const Vector2 shift{s.x[0] - origin.x, s.y[0] - origin.y};
  const double scale = 2 / (v1 - v0);
  const int n = s.degree;
  NodeValues<Nodes> values;
  for (int j = 0; j < Nodes; ++j) {
    const double v = 0.5 * (w0 + w1 + (w1 - w0) * nodes[j]);
    const double x = (v - v0) * scale - 1;
    const double t = (1 + x) * (0.5 + (1 - x) * (map.k0 + map.k1 * x));
    const double u = v - s.middle;
    double px = s.x[n], py = s.y[n];
    double qx = px, qy = py;  // by Horner's rule with its derivative
    for (int i = n - 1; i > 0; --i) {
      px = s.x[i] + u * px;
      py = s.y[i] + u * py;
      qx = px + u * qx;
      qy = py + u * qy;
    }
    const double dx = t * (c1.x + t * (c2.x + t * c3.x)) - u * px - shift.x;
    const double dy = t * (c1.y + t * (c2.y + t * c3.y)) - u * py - shift.y;
    values.across[j] = dx * qy - dy * qx;
    values.square[j] = dx * dx + dy * dy;
    values.pace = std::max(values.pace, std::abs(qx * qx + qy * qy - 1));
  }
  return values;
}

/// Largest value over [-1, 1] of a polynomial of that degree from its largest at `nodes` Chebyshev
/// nodes ([Ehlich 1964]).
double whole(double value, int degree, int nodes) {
  return value / std::cos(degree * core::kPi / (2 * nodes));
}

/// Coefficients by Chebyshev's polynomials of the polynomial with these values at the nodes.
template <std::size_t Nodes>
std::array<double, Nodes> chebyshev_coefficients(const std::array<double, Nodes>& values) {
  const auto& polynomial = Chebyshev<Nodes, Nodes - 1>::table().polynomial;
  std::array<std::array<double, Nodes / 2>, 2> parity;  // even, odd
  for (std::size_t j = 0; j < Nodes / 2; ++j) {
    parity[0][j] = values[j] + values[Nodes - 1 - j];
    parity[1][j] = values[j] - values[Nodes - 1 - j];
  }
  std::array<double, Nodes> coefficient;
  for (std::size_t k = 0; k < Nodes; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j < Nodes / 2; ++j) sum += polynomial[k][j] * parity[k % 2][j];
    coefficient[k] = sum * (k == 0 ? 1.0 : 2.0) / Nodes;
  }
  return coefficient;
}

/// Bound over [-1, 1] of the polynomial with these values at the nodes: what carries it, of degree
/// 12 at most, from many nodes; the rest by the sum of its coefficients.
template <std::size_t Nodes>
double polynomial_bound(const std::array<double, Nodes>& values, double negligible) {
  const auto& fine = Chebyshev<kFineNodes, kFineDegree>::table().polynomial;
  const std::array<double, Nodes> coefficient = chebyshev_coefficients(values);
  double rest = 0;
  int degree = Nodes - 1;
  while (degree > 1 && (degree > kFineDegree || rest + std::abs(coefficient[degree]) < negligible))
    rest += std::abs(coefficient[degree--]);
  std::array<std::array<double, kFineNodes / 2>, 2> parity{};  // even, odd part at the nodes
  for (int k = 0; k <= degree; ++k)
    for (int j = 0; j < kFineNodes / 2; ++j) parity[k % 2][j] += coefficient[k] * fine[k][j];
  double largest = 0;
  for (int j = 0; j < kFineNodes / 2; ++j)
    largest = std::max(largest, std::abs(parity[0][j]) + std::abs(parity[1][j]));
  return whole(largest, degree, kFineNodes) + rest;
}

/// Bound for all of [w0, w1], Nodes above the degree of all polynomials. A point at D = a along + b
/// across the curve is within |b| of it, up to what the curve bends over the length a: a^2 / 2
/// times curvature.
template <int Nodes>
double stretch_bound(const SeriesTable::Stretch& s, double w0, double w1, double v0, double v1,
                     const Cubic& c, const ParameterMap& map, double wanted) {
  const NodeValues<Nodes> at = node_values<Nodes>(s, w0, w1, v0, v1, c, map);
  const double pace = 1 - whole(at.pace, 2 * s.degree - 2, Nodes);
  const double square = *std::max_element(at.square.begin(), at.square.end());
  double any = whole(std::sqrt(square), std::max(kCarried, s.degree), Nodes);
  // Roughly first: mostly it does not matter.
  if (!(any * any * s.curvature < 1e-3 * wanted))
    any = std::min(any, std::sqrt(polynomial_bound(at.square, 1e-3 * square)));
  if (!(pace > 0.5) || !(any < 0.1) || std::isinf(s.curvature)) return any + s.remainder;
  const double across = polynomial_bound(at.across, 1e-3 * wanted) / std::sqrt(pace);
  return std::min(any, across + any * any * s.curvature) + s.remainder;
}

}  // namespace

double cubic_bound(const SeriesTable& table, double v0, double v1, const Cubic& c, double wanted) {
  const ParameterMap map = parameter_map(table, v0, v1, c);
  double largest = 0;
  for (const auto& s : table.stretches()) {
    const double w0 = std::max(v0, s.from);
    const double w1 = std::min(v1, s.to);
    if (!(w0 < w1)) continue;
    const double bound = s.degree <= kCarried
                             ? stretch_bound<2 * kCarried + 2>(s, w0, w1, v0, v1, c, map, wanted)
                             : stretch_bound<kDegree + 3>(s, w0, w1, v0, v1, c, map, wanted);
    if (!std::isfinite(bound)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, bound);
  }
  return largest + 2e-15;
}

}  // namespace keyline::lac::detail
