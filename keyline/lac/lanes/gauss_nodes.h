#pragma once

namespace keyline::lac::detail {

/// Gauss-Legendre rule on [0, 1], aligned for every instruction set.
struct GaussNodes {
  alignas(64) double nodes[32];
  alignas(64) double weights[32];
};

/// The rule with 8, 12, 16, 24 or 32 nodes.
const GaussNodes& gauss_nodes(int count);

}  // namespace keyline::lac::detail
