#include "keyline/lac/lanes/gauss_nodes.h"

#include "keyline/numeric/quadrature.h"

namespace keyline::lac::detail {
namespace {

template <std::size_t N>
constexpr GaussNodes aligned_rule() {
  GaussNodes rule{};
  for (std::size_t i = 0; i < N; ++i) {
    rule.nodes[i] = numeric::gauss_legendre<N>.nodes[i];
    rule.weights[i] = numeric::gauss_legendre<N>.weights[i];
  }
  return rule;
}

constexpr GaussNodes kEight = aligned_rule<8>();
constexpr GaussNodes kTwelve = aligned_rule<12>();
constexpr GaussNodes kSixteen = aligned_rule<16>();
constexpr GaussNodes kTwentyFour = aligned_rule<24>();
constexpr GaussNodes kThirtyTwo = aligned_rule<32>();

}  // namespace

const GaussNodes& gauss_nodes(int count) {
  if (count <= 12) return count <= 8 ? kEight : kTwelve;
  return count <= 16 ? kSixteen : count <= 24 ? kTwentyFour : kThirtyTwo;
}

}  // namespace keyline::lac::detail
