#include "keyline/fairing/chain_weights.h"

#include <cmath>

namespace keyline::fairing {

void weigh_up(std::vector<FitPoint>& points, const std::vector<FitPoint>& original,
              const std::vector<double>& offsets, double tolerance, numeric::Push push) {
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (points[j].must_pass) continue;
    const double share = std::abs(offsets[j]) / tolerance;
    points[j].weight = numeric::pushed_weight(points[j].weight, original[j].weight, share, push);
  }
}

}  // namespace keyline::fairing
