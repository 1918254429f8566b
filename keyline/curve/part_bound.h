#pragma once

#include <algorithm>
#include <cstddef>

#include "keyline/curve/bezier.h"
#include "keyline/curve/jet.h"

/// Bounds of the distance between two Béziers, in the plane or in space.
namespace keyline::curve {

/// Largest distance of two curves at equal parameter, bounded by their control points.
template <class Point>
double difference_bound(Bezier<Point> a, Bezier<Point> b) {
  const int most = std::max(degree(a), degree(b));
  a = elevate_degree(a, most - degree(a));
  b = elevate_degree(b, most - degree(b));
  double largest = 0;
  for (std::size_t i = 0; i < a.control.size(); ++i)
    largest = std::max(largest, distance(a.control[i], b.control[i]));
  return largest;
}

/// Foot of p on q near u, kept within [low, high].
template <class Point>
double foot_between(const Bezier<Point>& q, Point p, double u, double low, double high) {
  for (int i = 0; i < 6; ++i) {
    const auto j = jet(q, u);
    const auto off = j.point - p;
    const double square = dot(j.first, j.first);
    const double slope = std::max(square + dot(off, j.second), 0.25 * square);
    if (!(slope > 0)) break;
    u = std::clamp(u - dot(off, j.first) / slope, low, high);
  }
  return u;
}

/// Bound of the distance, either way, of the polynomial h from the polynomial q over [u0, u1],
/// start compared with start and end with end: h is halved where that is above `wanted`, each half
/// compared with what lies between the feet of its ends.
template <class Point>
double part_bound(const Bezier<Point>& h, const Bezier<Point>& q, double u0, double u1,
                  double wanted, int halvings = 11) {
  const double bound = difference_bound(h, subcurve(q, u0, u1));
  if (bound <= wanted || halvings == 0) return bound;
  const auto [left, right] = split(h, 0.5);
  const double u = foot_between(q, left.control.back(), 0.5 * (u0 + u1), u0, u1);
  const double halves = std::max(part_bound(left, q, u0, u, wanted, halvings - 1),
                                 part_bound(right, q, u, u1, wanted, halvings - 1));
  return std::min(bound, halves);
}

}  // namespace keyline::curve
