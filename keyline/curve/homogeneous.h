#pragma once

#include <array>

#include "keyline/core/point.h"
#include "keyline/curve/jet.h"

/// Internals of room curve: evaluation kernels over any vector space V (Vector2, Vector3,
/// Homogeneous), so that polynomial and rational curves share them.
namespace keyline::curve::detail {

inline constexpr int kMaxDegree = 30;

/// Weighted point: (weight * position, weight).
template <class Point>
struct Homogeneous {
  core::Displacement<Point> vector;
  double weight = 0;
};
template <class P>
Homogeneous<P> operator+(const Homogeneous<P>& a, const Homogeneous<P>& b) {
  return {a.vector + b.vector, a.weight + b.weight};
}
template <class P>
Homogeneous<P> operator-(const Homogeneous<P>& a, const Homogeneous<P>& b) {
  return {a.vector - b.vector, a.weight - b.weight};
}
template <class P>
Homogeneous<P> operator*(double k, const Homogeneous<P>& a) {
  return {k * a.vector, k * a.weight};
}

template <class Point>
core::Displacement<Point> from_origin(const Point& p) {
  return p - Point{};
}
template <class Point>
Homogeneous<Point> lift(const Point& p, double weight) {
  return {weight * from_origin(p), weight};
}
template <class Point>
Point project(const Homogeneous<Point>& h) {
  return Point{} + h.vector / h.weight;
}

template <class V>
using Derivatives = std::array<V, 4>;  ///< value, first, second, third

/// One de Casteljau level on b[0..count-1].
template <class V>
void casteljau_level(V* b, int count, double t) {
  for (int i = 0; i + 1 < count; ++i) b[i] = (1 - t) * b[i] + t * b[i + 1];
}

/// Value of the Bézier polynomial with coefficients b[0..degree]; b is overwritten.
template <class V>
V bezier_value(V* b, int degree, double t) {
  for (int count = degree + 1; count > 1; --count) casteljau_level(b, count, t);
  return b[0];
}

/// Value and three derivatives from the last levels of de Casteljau's scheme; b is overwritten.
template <class V>
Derivatives<V> bezier_derivatives(V* b, int degree, double t) {
  Derivatives<V> d{};
  const double n = degree;
  for (int left = degree; left >= 0; --left) {  // b[0..left] is the level of degree `left`
    if (left == 3) d[3] = n * (n - 1) * (n - 2) * ((b[3] - b[0]) + 3.0 * (b[1] - b[2]));
    if (left == 2) d[2] = n * (n - 1) * ((b[2] - b[1]) - (b[1] - b[0]));
    if (left == 1) d[1] = n * (b[1] - b[0]);
    if (left > 0) casteljau_level(b, left + 1, t);
  }
  d[0] = b[0];
  return d;
}

/// Level r of de Boor's scheme on span [knots[span], knots[span+1]), which is not empty:
/// d[r..degree] from d[r-1..degree] of the level before.
template <class V>
void de_boor_level(V* d, const double* knots, int degree, int span, int r, double u) {
  for (int j = degree; j >= r; --j) {
    const double low = knots[span - degree + j];
    const double a = (u - low) / (knots[span + 1 - r + j] - low);
    d[j] = (1 - a) * d[j - 1] + a * d[j];
  }
}

/// De Boor's scheme of the given degree; d[0..degree] are the control values span-degree … span and
/// are overwritten.
template <class V>
V de_boor(V* d, const double* knots, int degree, int span, double u) {
  for (int r = 1; r <= degree; ++r) de_boor_level(d, knots, degree, span, r, u);
  return d[degree];
}

/// Derivative of that order from d[degree-order..degree] of the scheme's level degree - order:
/// values of the blossom whose other arguments are neighbouring knots, so that each difference over
/// the knots' distance takes one argument for a direction.
template <class V>
V difference_of(const V* d, const double* knots, int degree, int span, int order) {
  std::array<V, 4> w;
  for (int i = 0; i <= order; ++i) w[i] = d[degree - order + i];
  for (int q = 1; q <= order; ++q)
    for (int i = order; i >= q; --i) {
      const double width = knots[span + 1 - q + i] - knots[span - order + i];
      w[i] = ((degree - order + q) / width) * (w[i] - w[i - 1]);
    }
  return w[order];
}

/// Value and three derivatives in u, from the last levels of one scheme; d as in de_boor. Control
/// values are taken from the first one, so that differences keep their digits far from the origin.
/// O(degree^2), no allocation.
template <class V>
Derivatives<V> spline_derivatives(V* d, const double* knots, int degree, int span, double u) {
  const V first = d[0];
  for (int j = 0; j <= degree; ++j) d[j] = d[j] - first;
  Derivatives<V> result{};
  for (int r = 0; r <= degree; ++r) {
    if (r > 0) de_boor_level(d, knots, degree, span, r, u);
    if (degree - r <= 3) result[degree - r] = difference_of(d, knots, degree, span, degree - r);
  }
  result[0] = first + result[0];
  return result;
}

template <class Point>
Jet<Point> to_jet(const Derivatives<core::Displacement<Point>>& d) {
  return {Point{} + d[0], d[1], d[2], d[3]};
}

/// Quotient rule: from derivatives of (w p, w) to those of p.
template <class Point>
Jet<Point> to_jet(const Derivatives<Homogeneous<Point>>& d) {
  const double w = d[0].weight;
  const auto p0 = d[0].vector / w;
  const auto p1 = (d[1].vector - d[1].weight * p0) / w;
  const auto p2 = (d[2].vector - 2 * d[1].weight * p1 - d[2].weight * p0) / w;
  const auto p3 =
      (d[3].vector - 3 * d[1].weight * p2 - 3 * d[2].weight * p1 - d[3].weight * p0) / w;
  return {Point{} + p0, p1, p2, p3};
}

}  // namespace keyline::curve::detail
