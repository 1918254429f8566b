#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace keyline::numeric {

/// Nodes and weights of a quadrature rule with N nodes on [0, 1]; nodes increase.
template <std::size_t N>
struct QuadratureRule {
  std::array<double, N> nodes{};
  std::array<double, N> weights{};
};

namespace detail {

struct LegendreValue {
  long double value, derivative;
};

/// Legendre polynomial P_n and its derivative at x, |x| < 1.
constexpr LegendreValue legendre(std::size_t n, long double x) {
  long double before = 1;
  long double value = x;
  for (std::size_t k = 2; k <= n; ++k) {
    const long double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {value, n * (x * value - before) / (x * x - 1)};
}

/// cos on [0, pi] by its series: only a first guess for Newton's method.
constexpr long double rough_cos(long double x) {
  long double term = 1;
  long double sum = 1;
  for (int k = 1; k < 15; ++k) {
    term *= -x * x / ((2 * k - 1) * (2 * k));
    sum += term;
  }
  return sum;
}

template <std::size_t N>
constexpr QuadratureRule<N> make_gauss_legendre() {
  QuadratureRule<N> rule;
  for (std::size_t i = 0; i < N; ++i) {
    long double x = -rough_cos(3.14159265358979323846L * (i + 0.75L) / (N + 0.5L));
    for (int step = 0; step < 6; ++step) {
      const LegendreValue p = legendre(N, x);
      x -= p.value / p.derivative;
    }
    const long double slope = legendre(N, x).derivative;
    rule.nodes[i] = static_cast<double>((1 + x) / 2);
    rule.weights[i] = static_cast<double>(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

}  // namespace detail

/// Gauss-Legendre rule on [0, 1], 2 <= N <= 64: exact for polynomials of degree 2N - 1.
template <std::size_t N>
inline constexpr QuadratureRule<N> gauss_legendre = detail::make_gauss_legendre<N>();

/// Integral of f over [low, high] by the N-point Gauss-Legendre rule.
template <std::size_t N, class F>
auto integrate_gauss(F&& f, double low, double high) {
  constexpr const QuadratureRule<N>& rule = gauss_legendre<N>;
  const double width = high - low;
  auto sum = (width * rule.weights[0]) * f(low + width * rule.nodes[0]);
  for (std::size_t i = 1; i < N; ++i) {
    sum = sum + (width * rule.weights[i]) * f(low + width * rule.nodes[i]);
  }
  return sum;
}

}  // namespace keyline::numeric
