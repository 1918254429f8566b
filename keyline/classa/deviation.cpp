#include "keyline/classa/deviation.h"

#include <algorithm>

#include "keyline/curve/chain_deviation.h"
#include "keyline/curve/jet.h"

namespace keyline::classa {

double deviation_bound(std::span<const curve::Bezier2> row, const curve::Bezier2& q,
                       double wanted) {
  return curve::deviation_bound({{row.begin(), row.end()}, 0}, {{q}, 0}, wanted);
}

namespace {

using curve::Bezier3;

/// Largest distance at equal parameter, bounded by control points.
double difference(Bezier3 a, Bezier3 b) {
  const int most = std::max(degree(a), degree(b));
  a = elevate_degree(a, most - degree(a));
  b = elevate_degree(b, most - degree(b));
  double largest = 0;
  for (std::size_t i = 0; i < a.control.size(); ++i)
    largest = std::max(largest, distance(a.control[i], b.control[i]));
  return largest;
}

/// Foot of p on q near u, kept within [low, high].
double foot(const Bezier3& q, core::Point3 p, double u, double low, double high) {
  for (int i = 0; i < 6; ++i) {
    const curve::Jet3 j = jet(q, u);
    const core::Vector3 off = j.point - p;
    const double square = dot(j.first, j.first);
    const double slope = std::max(square + dot(off, j.second), 0.25 * square);
    if (!(slope > 0)) break;
    u = std::clamp(u - dot(off, j.first) / slope, low, high);
  }
  return u;
}

double part_bound(const Bezier3& c, const Bezier3& q, double u0, double u1, double wanted,
                  int halvings) {
  const double bound = difference(c, subcurve(q, u0, u1));
  if (bound <= wanted || halvings == 0) return bound;
  const auto [left, right] = split(c, 0.5);
  const double u = foot(q, left.control.back(), 0.5 * (u0 + u1), u0, u1);
  return std::min(bound, std::max(part_bound(left, q, u0, u, wanted, halvings - 1),
                                  part_bound(right, q, u, u1, wanted, halvings - 1)));
}

}  // namespace

double deviation_bound(const Bezier3& c, const Bezier3& q, double wanted) {
  return part_bound(c, q, 0, 1, wanted, 9);
}

}  // namespace keyline::classa
