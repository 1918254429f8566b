#pragma once

#include <array>
#include <cstddef>

#include "keyline/fit/quintic_joints.h"

namespace keyline::fit {

/// Rate of curvature times the root of the speed, whose square is what is integrated over t; and
/// what it changes by with the first three derivatives.
struct RateNode {
  double value = 0;
  core::Vector2 by_first, by_second, by_third;
};

constexpr std::size_t kRateNodes = 32;  ///< of a piece

/// Weights of control points at a node, the same for every piece; its share of t.
struct RatePlace {
  double weight = 0;
  QuinticWeights place, first, second, third;
};

/// Middles of even parts: more of them and of less order than Gauss's, so that no needle hides.
const std::array<RatePlace, kRateNodes>& rate_nodes();

RateNode rate_at(const JointedQuintic& piece, const RatePlace& node);

}  // namespace keyline::fit
