#pragma once

#include <vector>

#include "keyline/curve/bernstein.h"

/// Internals of room curve: polynomials whose signs decide about monotone curvature.
namespace keyline::curve::detail {

/// Homogeneous coordinates in scaled Bernstein coefficients; w is empty for a polynomial curve.
template <class T>
struct PlanarForm {
  Coefficients<T> x, y, w;
};

/// In scaled Bernstein coefficients: `rate` has the sign of dkappa/ds, `speed` that of the squared
/// speed (0 where the curve stops).
template <class T>
struct RateForm {
  Coefficients<T> rate, speed;
};

template <class T>
RateForm<T> polynomial_rate(const PlanarForm<T>& c) {
  const auto x1 = derivative(c.x);
  const auto y1 = derivative(c.y);
  const auto x2 = derivative(x1);
  const auto y2 = derivative(y1);
  const auto turn = combination(product(x1, y2), -1, product(y1, x2));
  const auto speed = combination(product(x1, x1), 1, product(y1, y1));
  const auto along = combination(product(x1, x2), 1, product(y1, y2));
  return {combination(product(derivative(turn), speed), -3, product(turn, along)), speed};
}

template <class T>
RateForm<T> rational_rate(const PlanarForm<T>& c) {
  const auto x1 = derivative(c.x);
  const auto y1 = derivative(c.y);
  const auto w1 = derivative(c.w);
  const auto x2 = derivative(x1);
  const auto y2 = derivative(y1);
  const auto w2 = derivative(w1);
  const auto minor = [](const auto& a, const auto& b, const auto& a2, const auto& b2) {
    return combination(product(a, b2), -1, product(a2, b));
  };
  const auto turn = combination(
      combination(product(c.x, minor(y1, w1, y2, w2)), -1, product(c.y, minor(x1, w1, x2, w2))), 1,
      product(c.w, minor(x1, y1, x2, y2)));
  const auto nx = combination(product(x1, c.w), -1, product(c.x, w1));
  const auto ny = combination(product(y1, c.w), -1, product(c.y, w1));
  const auto speed = combination(product(nx, nx), 1, product(ny, ny));
  const auto along = combination(product(nx, derivative(nx)), 1, product(ny, derivative(ny)));
  const auto growth = combination(product(c.w, derivative(turn)), 3, product(w1, turn));
  return {combination(product(growth, speed), -3, product(product(c.w, turn), along)), speed};
}

template <class T>
RateForm<T> rate_form(const PlanarForm<T>& c) {
  return c.w.empty() ? polynomial_rate(c) : rational_rate(c);
}

}  // namespace keyline::curve::detail
