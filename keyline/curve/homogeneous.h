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

/// De Boor's scheme of the given degree on span [knots[span], knots[span+1]), which is not empty;
/// d[0..degree] are the control values span-degree … span and are overwritten.
template <class V>
V de_boor(V* d, const double* knots, int degree, int span, double u) {
  for (int r = 1; r <= degree; ++r) {
    for (int j = degree; j >= r; --j) {
      const double low = knots[span - degree + j];
      const double high = knots[span + 1 - r + j];
      const double a = (u - low) / (high - low);
      d[j] = (1 - a) * d[j - 1] + a * d[j];
    }
  }
  return d[degree];
}

/// Value and three derivatives in u; d as in de_boor. O(degree^2), no allocation.
template <class V>
Derivatives<V> spline_derivatives(V* d, const double* knots, int degree, int span, double u) {
  Derivatives<V> result{};
  std::array<V, kMaxDegree + 1> work;
  for (int order = 0; order <= 3 && order <= degree; ++order) {
    const int p = degree - order;
    for (int j = 0; j <= p; ++j) work[j] = d[j];
    result[order] = de_boor(work.data(), knots, p, span, u);
    for (int j = 0; j < p; ++j) {
      const double width = knots[span + 1 + j] - knots[span + 1 + j - p];
      d[j] = (p / width) * (d[j + 1] - d[j]);
    }
  }
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
