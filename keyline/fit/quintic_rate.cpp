#include "keyline/fit/quintic_rate.h"

#include <cmath>

namespace keyline::fit {
namespace {

using core::cross;
using core::dot;
using core::Vector2;

/// From the first three derivatives.
RateNode rate_node(Vector2 v, Vector2 a, Vector2 j) {
  const double q = dot(v, v);
  if (!(q > 0)) return {};
  const double c = cross(v, a);
  const double e = cross(v, j);
  const double f = dot(v, a);
  const double speed = std::sqrt(q);
  const double q7 = 1 / (q * speed * std::sqrt(speed));
  const double q11 = q7 / q;
  const auto left = [](Vector2 x) { return core::perpendicular_left(x); };
  RateNode node;
  node.value = e * q7 - 3 * c * f * q11;
  // cross(dv, x) = -dot(dv, left of x), cross(v, dx) = dot(left of v, dx)
  node.by_first = (-q7) * left(j) + (3 * f * q11) * left(a) - (3 * c * q11) * a +
                  (-3.5 * e * q11 + 16.5 * c * f * q11 / q) * v;
  node.by_second = (-3 * f * q11) * left(v) - (3 * c * q11) * v;
  node.by_third = q7 * left(v);
  return node;
}

}  // namespace

const std::array<RatePlace, kRateNodes>& rate_nodes() {
  static const std::array<RatePlace, kRateNodes> all = [] {
    std::array<RatePlace, kRateNodes> made;
    for (std::size_t i = 0; i < kRateNodes; ++i) {
      const double t = (static_cast<double>(i) + 0.5) / kRateNodes;
      made[i] = {1.0 / kRateNodes, place_weights(t), first_weights(t), second_weights(t),
                 third_weights(t)};
    }
    return made;
  }();
  return all;
}

RateNode rate_at(const JointedQuintic& piece, const RatePlace& node) {
  const QuinticHandles& h = piece.control;
  return rate_node(weighted(h, node.first), weighted(h, node.second), weighted(h, node.third));
}

}  // namespace keyline::fit
