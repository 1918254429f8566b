#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// Internals of room curve: polynomials on [0, 1] in Bernstein form over any ring T (double,
/// doubles with error bounds, integers). Products and sums use *scaled* coefficients
/// s_i = C(n, i) b_i, in which multiplication is plain convolution and the derivative needs
/// integers only; the size of the vector is degree + 1.
namespace keyline::curve::detail {

template <class T>
using Coefficients = std::vector<T>;

/// C(n, k) for all k, by additions: exact for any T that holds them.
template <class T>
std::vector<T> binomials(std::size_t n) {
  std::vector<T> row{T(1)};
  for (std::size_t i = 1; i <= n; ++i) {
    row.push_back(T(1));
    for (std::size_t k = i - 1; k > 0; --k) row[k] = row[k] + row[k - 1];
  }
  return row;
}

/// Scaled coefficients from plain ones.
template <class T>
Coefficients<T> scaled(Coefficients<T> b) {
  const auto c = binomials<T>(b.size() - 1);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = c[i] * b[i];
  return b;
}

template <class T>
Coefficients<T> product(const Coefficients<T>& a, const Coefficients<T>& b) {
  Coefficients<T> r(a.size() + b.size() - 1, T(0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) r[i + j] = r[i + j] + a[i] * b[j];
  return r;
}

/// Scaled coefficients at a degree of at least size - 1.
template <class T>
Coefficients<T> elevated(Coefficients<T> a, std::size_t size) {
  while (a.size() < size) {
    a.push_back(T(0));
    for (std::size_t i = a.size() - 1; i > 0; --i) a[i] = a[i] + a[i - 1];
  }
  return a;
}

/// a + factor b, of whichever degree is higher.
template <class T>
Coefficients<T> combination(const Coefficients<T>& a, int factor, const Coefficients<T>& b) {
  const std::size_t size = std::max(a.size(), b.size());
  Coefficients<T> r = elevated(a, size);
  const Coefficients<T> e = elevated(b, size);
  for (std::size_t i = 0; i < size; ++i) r[i] = r[i] + T(factor) * e[i];
  return r;
}

/// Derivative; of a constant, the constant 0.
template <class T>
Coefficients<T> derivative(const Coefficients<T>& a) {
  if (a.size() < 2) return {T(0)};
  const std::size_t n = a.size() - 1;
  Coefficients<T> r;
  for (std::size_t i = 0; i < n; ++i)
    r.push_back(T(static_cast<int>(i + 1)) * a[i + 1] - T(static_cast<int>(n - i)) * a[i]);
  return r;
}

/// Plain coefficients from scaled ones.
inline Coefficients<double> unscaled(Coefficients<double> a) {
  const auto c = binomials<double>(a.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] /= c[i];
  return a;
}

/// Halves of a polynomial in plain coefficients.
struct Halves {
  Coefficients<double> left, right;
};
Halves halves(Coefficients<double> b);

/// Value of a polynomial in plain coefficients.
double value_at(Coefficients<double> b, double t);

/// Parameters in [0, 1] where the polynomial with the plain coefficients b changes sign, in
/// increasing order, each to about 1e-15; none for the zero polynomial. Isolated by the number of
/// sign changes of the coefficients under subdivision, so that none is missed (up to rounding of
/// b); several roots nearer than 1e-13 may come as one.
std::vector<double> roots_in_unit(const Coefficients<double>& b);

}  // namespace keyline::curve::detail
