#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

/// Weights of least squares that grow where the distance is large, so that repeated fits come to
/// the least largest distance (Lawson 1961).
namespace keyline::numeric {

/// Each weight by its distance (nowhere below a thousandth of the largest), their sum kept at their
/// number; all 1 where no distance is above 0.
inline void lawson_weights(std::span<double> weights, std::span<const double> distances) {
  const double largest = *std::max_element(distances.begin(), distances.end());
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] *= distances[i] + 1e-3 * largest;
    sum += weights[i];
  }
  if (!(sum > 0)) {
    std::fill(weights.begin(), weights.end(), 1.0);
    return;
  }
  for (double& weight : weights) weight *= static_cast<double>(weights.size()) / sum;
}

/// How hard a round pushes: a weight's factor at no distance, and what it gains up to the
/// tolerance.
struct Push {
  double rest;
  double gain;
};

/// Lawson's rule against a tolerance: a weight that was `first` at the start, of a point `share` of
/// the tolerance away. No weight grows ten thousandfold, or the others would be lost to rounding.
inline double pushed_weight(double weight, double first, double share, Push push) {
  return std::min(1e4 * first, weight * (push.rest + push.gain * share * share));
}

}  // namespace keyline::numeric
