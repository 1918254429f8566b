#include "keyline/fit/chain_displacement.h"

#include <array>
#include <cstddef>

#include "keyline/curve/jet.h"

namespace keyline::fit {
namespace {

constexpr std::array<double, 4> kPlaces = {0.25, 0.5, 0.75, 1};

/// How much of the n-th control edge counts at u: the Bernstein polynomials of degree 5 from the
/// edge's end on.
std::array<double, kEdges> edge_weights(double u) {
  const double v = 1 - u;
  const std::array<double, 6> b = {v * v * v * v * v,      5 * v * v * v * v * u,
                                   10 * v * v * v * u * u, 10 * v * v * u * u * u,
                                   5 * v * u * u * u * u,  u * u * u * u * u};
  std::array<double, kEdges> weights{};
  double sum = 0;
  for (std::size_t n = kEdges; n-- > 0;) weights[n] = sum += b[n + 1];
  return weights;
}

}  // namespace

ChainDisplacement::ChainDisplacement(const curve::PiecewiseBezier& start,
                                     const std::vector<Edges>& edges) {
  const auto all = static_cast<Eigen::Index>(kEdges * edges.size());
  start_.resize(all);
  by_length_.setZero(static_cast<Eigen::Index>(kPlaces.size() * edges.size()), all);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto own = static_cast<Eigen::Index>(kEdges * i);
    for (std::size_t n = 0; n < kEdges; ++n)
      start_[own + static_cast<Eigen::Index>(n)] = edges[i].length[n];
    for (std::size_t k = 0; k < kPlaces.size(); ++k) {
      const core::Vector2 normal =
          core::perpendicular_left(unit_tangent(jet(start.pieces[i], kPlaces[k])));
      const auto weights = edge_weights(kPlaces[k]);
      auto row = by_length_.row(static_cast<Eigen::Index>(kPlaces.size() * i + k));
      for (std::size_t j = 0; j <= i; ++j)
        for (std::size_t n = 0; n < kEdges; ++n)
          row[static_cast<Eigen::Index>(kEdges * j + n)] =
              core::dot(normal, edges[j].direction[n]) * (j < i ? 1 : weights[n]);
    }
  }
}

}  // namespace keyline::fit
