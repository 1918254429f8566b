#include "keyline/classa/strain_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/numeric/quadrature.h"

namespace keyline::classa {

namespace {

double turning_of(const curve::Jet2& j) { return std::abs(cross(j.first, j.second)); }
double turning_of(const curve::Jet3& j) { return norm(cross(j.first, j.second)); }

/// Squared curvature by parameter. `size` is the largest speed: a turning below the rounding of
/// derivatives of that size counts as none.
template <class Jet>
double density(const Jet& j, double size) {
  const double speed = norm(j.first);
  if (speed == 0) return 0;
  const double turning = turning_of(j);
  if (turning <= 4e-15 * speed * size) return 0;
  const double curvature = turning / (speed * speed * speed);
  return curvature * curvature * speed;
}

template <class Curve>
struct Integration {
  const Curve* curve;
  double size;       // largest speed
  double tolerance;  // relative
  double floor;      // energy the tolerance is relative to: what has been met so far
  double energy = 0;
  bool singular = false;
  int stretches = 0;

  double rule(double low, double high) const {
    const auto f = [this](double t) { return density(jet(*curve, t), size); };
    return numeric::integrate_gauss<15>(f, low, high);
  }
};

/// Halves a stretch until the rule agrees with its two halves; a stretch that cannot be halved any
/// more and still holds a part of the energy has a singularity in it.
template <class Curve>
void integrate(Integration<Curve>& work, double low, double high, double whole, int depth) {
  constexpr int kMostStretches = 20000;
  const double middle = 0.5 * (low + high);
  const double left = work.rule(low, middle);
  const double right = work.rule(middle, high);
  work.floor = std::max(work.floor, left + right);
  const double error = std::abs(left + right - whole);
  const bool met = error <= work.tolerance * work.floor * 1e-2;
  if (met || depth == 0 || ++work.stretches > kMostStretches) {
    work.energy += left + right;
    work.singular = work.singular || (!met && error > 1e-3 * (left + right));
  } else {
    integrate(work, low, middle, left, depth - 1);
    integrate(work, middle, high, right, depth - 1);
  }
}

/// A cusp at which the curve turns on.
template <class Curve>
bool diverges_at(const Curve& c, double t, double size) {
  const auto j = jet(c, t);
  const auto next = cross(j.second, j.third);
  return norm(j.first) <= 1e-13 * size && !(next == decltype(next){});
}

template <class Curve>
double energy_of(const Curve& c, double tolerance) {
  constexpr int kDepth = 40;
  double size = 0;
  for (int i = 0; i <= 8; ++i) size = std::max(size, norm(jet(c, i / 8.0).first));
  if (size == 0) return 0;
  Integration<Curve> work{&c, size, tolerance, 1e-20 / size};
  const std::vector<double> breaks = breakpoints(c);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double low = breaks[i];
    const double high = std::nextafter(breaks[i + 1], low);
    if (diverges_at(c, low, size) || diverges_at(c, high, size))
      return std::numeric_limits<double>::infinity();
    integrate(work, low, high, work.rule(low, high), kDepth);
  }
  return work.singular ? std::numeric_limits<double>::infinity() : work.energy;
}

double whole_power(double x, int exponent) {
  double power = 1;
  for (; exponent > 0; exponent /= 2, x *= x)
    if (exponent % 2 != 0) power *= x;
  return power;
}

}  // namespace

double strain_energy(const curve::PlanarView& c, double tolerance) {
  return energy_of(c, tolerance);
}

double strain_energy(const curve::Bezier3& c, double tolerance) { return energy_of(c, tolerance); }

MatrixEnergy matrix_energy(const ControlMatrix& m, int degree) {
  MatrixEnergy energy;
  if (m.alpha == 0 || degree < 2) return energy;
  constexpr int kNodes = 20;
  const auto& rule = numeric::gauss_legendre<kNodes>;
  const double sine = std::sin(m.alpha);
  const double cosine = std::cos(m.alpha);
  const double k = (1 / m.s - cosine) / sine;
  double sum = 0;     // of p^(n+1), p = cos psi + k sin psi = 1/|1 - t + t z|
  double moment = 0;  // of p^n sin psi
  for (int i = 0; i < kNodes; ++i) {
    const double psi = m.alpha * rule.nodes[i];
    const double sin_psi = std::sin(psi);
    const double p = std::cos(psi) + k * sin_psi;
    const double power = rule.weights[i] * whole_power(p, degree);
    sum += power * p;
    moment += power * sin_psi;
  }
  sum *= m.alpha;
  moment *= m.alpha;
  const double n = degree;
  energy.value = (n - 1) * (n - 1) / n * m.s * sine * sum;
  const double by_k = (n + 1) * moment / sum;
  const double cotangent = cosine / sine;
  const double end = std::pow(m.s, -(n + 1)) / sum;
  energy.log_by_alpha = cotangent + end + by_k * (1 - k * cotangent);
  energy.log_by_s = 1 / m.s - by_k / (m.s * m.s * sine);
  return energy;
}

double strain_energy(const MatrixCurve& c) {
  const ControlMatrix m{std::abs(c.matrix.alpha), c.matrix.s};
  return matrix_energy(m, c.degree).value / (c.beta * norm(c.tangent));
}

}  // namespace keyline::classa
