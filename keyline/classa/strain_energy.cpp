#include "keyline/classa/strain_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/numeric/quadrature.h"

namespace keyline::classa {

using core::Vector2;

namespace {

/// Squared curvature by parameter; a turning below rounding counts as none.
double density(const curve::Jet2& j) {
  const double speed = norm(j.first);
  if (speed == 0) return 0;
  const double turning = cross(j.first, j.second);
  if (std::abs(turning) <= 4e-16 * speed * norm(j.second)) return 0;
  const double curvature = turning / (speed * speed * speed);
  return curvature * curvature * speed;
}

struct Spread {
  double energy = 0;
  bool singular = false;
};

/// Halves a stretch until the rule agrees with its two halves; a stretch that cannot be halved any
/// more and still holds a part of the energy has a singularity in it.
void integrate(const curve::PlanarView& c, double low, double high, double whole, double tolerance,
               double& floor, int depth, Spread& spread) {
  const auto f = [&c](double t) { return density(jet(c, t)); };
  const double middle = 0.5 * (low + high);
  const double left = numeric::integrate_gauss<15>(f, low, middle);
  const double right = numeric::integrate_gauss<15>(f, middle, high);
  floor = std::max(floor, left + right);
  const double error = std::abs(left + right - whole);
  if (error <= tolerance * floor * 1e-2) {
    spread.energy += left + right;
  } else if (depth == 0) {
    spread.energy += left + right;
    spread.singular = spread.singular || error > 1e-3 * (left + right);
  } else {
    integrate(c, low, middle, left, tolerance, floor, depth - 1, spread);
    integrate(c, middle, high, right, tolerance, floor, depth - 1, spread);
  }
}

bool diverges_at(const curve::PlanarView& c, double t, double size) {
  const curve::Jet2 j = jet(c, t);
  return norm(j.first) <= 1e-13 * size && cross(j.second, j.third) != 0;
}

}  // namespace

double strain_energy(const curve::PlanarView& c, double tolerance) {
  constexpr int kDepth = 40;
  double size = 0;
  for (int i = 0; i <= 8; ++i) size = std::max(size, norm(jet(c, i / 8.0).first));
  if (size == 0) return 0;
  Spread spread;
  double floor = 0;
  const std::vector<double>& breaks = c.breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double low = breaks[i];
    const double high = std::nextafter(breaks[i + 1], low);
    if (diverges_at(c, low, size) || diverges_at(c, high, size))
      return std::numeric_limits<double>::infinity();
    const auto f = [&c](double t) { return density(jet(c, t)); };
    const double whole = numeric::integrate_gauss<15>(f, low, high);
    integrate(c, low, high, whole, tolerance, floor, kDepth, spread);
  }
  return spread.singular ? std::numeric_limits<double>::infinity() : spread.energy;
}

MatrixEnergy matrix_energy(const ControlMatrix& m, int degree) {
  MatrixEnergy energy;
  if (m.alpha == 0 || degree < 2) return energy;
  constexpr int kNodes = 24;
  const auto& rule = numeric::gauss_legendre<kNodes>;
  const double sine = std::sin(m.alpha);
  const double cotangent = std::cos(m.alpha) / sine;
  double sum = 0;
  double by_alpha = 0;
  double by_s = 0;
  for (int i = 0; i < kNodes; ++i) {
    const double u = rule.nodes[i];
    const double a = std::sin(m.alpha * (1 - u)) / sine;
    const double b = std::sin(m.alpha * u) / sine;
    const double p = a + b / m.s;  // 1 / |1 - t + t z|
    double power = 1;
    for (int k = 0; k < degree; ++k) power *= p;
    const double slope = (degree + 1) * power * rule.weights[i];
    const double a_rate = (1 - u) * std::cos(m.alpha * (1 - u)) / sine - a * cotangent;
    const double b_rate = u * std::cos(m.alpha * u) / sine - b * cotangent;
    sum += rule.weights[i] * power * p;
    by_alpha += slope * (a_rate + b_rate / m.s);
    by_s -= slope * b / (m.s * m.s);
  }
  const double n = degree;
  energy.value = (n - 1) * (n - 1) / n * m.s * sine * m.alpha * sum;
  energy.log_by_alpha = cotangent + 1 / m.alpha + by_alpha / sum;
  energy.log_by_s = 1 / m.s + by_s / sum;
  return energy;
}

double strain_energy(const MatrixCurve& c) {
  const ControlMatrix m{std::abs(c.matrix.alpha), c.matrix.s};
  return matrix_energy(m, c.degree).value / (c.beta * norm(c.tangent));
}

}  // namespace keyline::classa
